#include "server/via_answers.hpp"

#include "base/error.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

constexpr double kSampledRate = 100;  // Hz

}  // namespace

Bytes spoken_stream(const Script& script, const Talker& talker, const StreamModel* model,
                    const std::function<void()>& check_wanted) {
    Motion motion;
    std::vector<Configuration> rows;
    std::vector<StreamPhone> phones;
    std::int64_t samples = 0;
    for (std::size_t sentence = 0; sentence < script.size(); ++sentence) {
        check_wanted();
        const Recital recital = recite(talker.codex, script.utterance(sentence));
        const int rate = recital.utterance.sound.sample_rate;
        const double begin = static_cast<double>(samples) / rate;
        samples += static_cast<std::int64_t>(recital.utterance.sound.samples.size());
        const double end = static_cast<double>(samples) / rate;
        const PhoneSequence& spoken = recital.utterance.phones;
        for (std::size_t i = 0; i < spoken.phones.size(); ++i)
            phones.push_back({spoken.phones[i].phone, begin + spoken.begin_s(i), begin + spoken.end_s(i)});
        std::vector<double> times;
        for (; static_cast<double>(motion.time_s.size()) / kSampledRate < end;) {
            motion.time_s.push_back(static_cast<double>(motion.time_s.size()) / kSampledRate);
            times.push_back(motion.time_s.back() - begin);
        }
        const RowMatrix positions = recital.motion.at(times);
        for (Eigen::Index i = 0; i < positions.rows(); ++i) rows.push_back(positions.row(i).transpose());
    }
    motion.positions.resize(static_cast<Eigen::Index>(rows.size()), kCoordinates);
    for (std::size_t i = 0; i < rows.size(); ++i)
        motion.positions.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    return encode_stream(motion, model,
                         {.max_error_mm = kAnsweredBound, .rounds = 1, .before_segment = check_wanted},
                         phones)
        .bytes;
}

std::string talker_of(const Bytes& stream) {
    try {
        const std::string named = peek_stream_head(stream).talker;
        return named.empty() ? kDefaultTalker : named;
    } catch (const std::runtime_error& error) {
        throw InputError("stream", std::to_string(stream.size()) + " bytes",
                         std::string("a stream of via points: ") + error.what());
    }
}

MotionInput streamed_motion(const Bytes& stream, const Talker& talker, std::vector<StreamModel> models) {
    std::erase_if(models, [&](const StreamModel& model) { return model.name != talker.name(); });
    MotionInputOptions options;
    options.stream_models = std::move(models);
    return motion_of(stream, "stream", talker, options);
}

}  // namespace viaface
