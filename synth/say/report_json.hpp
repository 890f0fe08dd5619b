// What was said, as JSON: the answer of /v1/viapoints and the report of `viaface say --json`.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "synth/say/say.hpp"

namespace viaface {

// Words, phones, via points and the lip opening of a script, without drawing it. What `check_wanted`, called
// before each sentence, throws ends it.
nlohmann::json viapoints_json(const Script& script, const SpeechRequest& request, const Talker& talker,
                              const std::function<void()>& check_wanted);

// Gathers words and phones of recitals as they come; times count from the first sample of all.
class Timeline {
  public:
    void add(const Recital& recital, std::int64_t first_sample);

    nlohmann::json words() const;
    nlohmann::json phones() const;

  private:
    Utterance whole_;
    std::vector<UnitLevel> levels_;  // [phones], the poorer of a pause's two halves
};

nlohmann::json report_json(const SayRequest& request, const std::string& talker, const Timeline& timeline,
                           const SayReport& report);

}  // namespace viaface
