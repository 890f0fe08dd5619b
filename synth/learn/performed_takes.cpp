#include "synth/learn/performed_takes.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/say/recital.hpp"
#include "synth/speech/text.hpp"
#include "synth/speech/text_grid.hpp"
#include "synth/speech/wav.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

// To a ten-thousandth of a mm.
Motion rounded(Motion motion) {
    motion.positions = (motion.positions * 1e4).array().round() / 1e4;
    return motion;
}

void write_take(const PerformedTake& performed, const std::filesystem::path& folder,
                const std::string& remark) {
    const std::string& name = performed.take.name;
    write_motion_csv(folder / (name + ".csv"), rounded(performed.take.motion),
                     {remark, "mm, head frame: x to the talker's left, y up, z forward"});
    const Bytes wave = write_wav(performed.utterance.sound);
    write_whole(folder / (name + ".wav"), std::span(wave));
    TextGrid grid;
    append_to(grid, performed.utterance, 0);
    write_whole(folder / (name + ".TextGrid"), std::string_view(write_text_grid(grid)));
    write_whole(folder / (name + ".txt"), std::string_view(performed.text + "\n"));
}

}  // namespace

PerformedTake perform(const Codex& codex, const std::string& name, const std::string& sentence,
                      const std::string& voice) {
    Recital recital = recite(codex, FliteVoice(voice).speak(sentence));
    Motion motion;
    const double end = recital.utterance.sound.seconds();
    for (int i = 0; i <= end * kPerformedRate; ++i)
        motion.time_s.push_back(static_cast<double>(i) / kPerformedRate);
    motion.positions = recital.motion.at(motion.time_s);
    return {{name, recital.utterance.phones, std::move(motion)}, std::move(recital.utterance), sentence};
}

void export_takes(const Codex& codex, const std::vector<std::string>& texts, const std::string& voice,
                  const std::filesystem::path& folder, const std::string& remark,
                  const std::function<void(double)>& progress) {
    std::vector<std::string> all;
    for (const std::string& text : texts) {
        for (std::string& sentence : sentences(text)) all.push_back(std::move(sentence));
    }
    WholeFolder whole(folder);
    for (std::size_t i = 0; i < all.size(); ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "%04zu", i + 1);
        write_take(perform(codex, name, all[i], voice), whole.path(), remark);
        if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(all.size()));
    }
    whole.commit();
}

}  // namespace viaface
