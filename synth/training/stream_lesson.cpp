#include "synth/training/stream_lesson.hpp"

#include "base/whole_file.hpp"
#include "synth/stream/bench_motions.hpp"
#include "synth/talker/stream_models.hpp"
#include "viapoints/stream_train.hpp"

namespace viaface {

void teach_stream(const std::filesystem::path& talker_folder, const std::filesystem::path& data,
                  const std::vector<std::string>& sentences,
                  const std::function<void(const std::string&)>& progress) {
    constexpr std::size_t kMostSentences = 20;
    progress("learning the stream model");
    const Talker talker = load_talker(talker_folder);
    std::vector<std::string> spoken(
        sentences.begin(),
        sentences.begin() + static_cast<std::ptrdiff_t>(std::min(sentences.size(), kMostSentences)));
    std::vector<Motion> motions = {spoken_motion(talker, spoken)};
    BenchMotions recorded = bench_motions(talker, data);
    for (BenchMotion& take : recorded.phrase_takes) motions.push_back(std::move(take.motion));
    for (const std::string& skipped : recorded.skipped) progress("the stream model does without " + skipped);
    write_whole(
        talker_folder / kStreamModelFile,
        write_stream_model(learn_stream_model(talker.name(), motions, {.also = shape_positions(talker)})));
}

}  // namespace viaface
