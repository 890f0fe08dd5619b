#include <cstdio>
#include <iostream>
#include <sstream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/via_command.hpp"
#include "server/via_models.hpp"
#include "synth/speech/text_grid.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {
namespace {

constexpr int kPhoneClock = 48000;  // Hz

struct Options {
    std::string motion, output, talker, model, phones;
    StreamOptions stream;
    bool live = false;
    double look_ahead_s = LiveOptions{}.look_ahead_s;
};

std::vector<StreamPhone> read_phones(const std::string& file) {
    if (file.empty()) return {};
    const PhoneSequence sequence = phones_of(read_text_grid(read_text(file, "phones")), kPhoneClock);
    std::vector<StreamPhone> phones;
    for (std::size_t i = 0; i < sequence.phones.size(); ++i)
        phones.push_back({sequence.phones[i].phone, sequence.begin_s(i), sequence.end_s(i)});
    return phones;
}

void print(const StreamAccount& a) {
    const auto per_second = [&](std::size_t bytes) { return 8 * static_cast<double>(bytes) / a.seconds; };
    std::printf("%zu via points in %zu segments, %.2f per s, of %.2f s\n", a.via_points, a.segments,
                static_cast<double>(a.via_points) / a.seconds, a.seconds);
    std::printf(
        "payload %.1f bit/s, whole %.1f bit/s (%zu bytes: head %zu, of which basis %zu; phones %zu)\n",
        per_second(a.payload_bytes), per_second(a.all_bytes), a.all_bytes, a.head_bytes, a.basis_bytes,
        a.phone_bytes);
    std::printf("largest error %.4f mm, rms %.4f mm at the motion's samples\n", a.max_error_mm,
                a.rms_error_mm);
}

int encode_file(const Options& options) {
    const auto model = stream_model_of(options.talker, options.model);
    const Motion motion = read_motion_csv(options.motion).motion;
    const EncodedStream encoded =
        encode_stream(motion, model.get(), options.stream, read_phones(options.phones));
    write_whole(options.output, encoded.bytes);
    print(encoded.account);
    return 0;
}

void send(const Bytes& bytes) {
    if (bytes.empty()) return;
    std::cout.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("packets cannot be written to stdout");
}

// Rows one by one, as they come.
int encode_live(const Options& options) {
    const auto model = stream_model_of(options.talker, options.model);
    if (!model)
        throw InputError("talker", "",
                         "for --live a talker, or --model: the basis must be known before the motion");
    std::string header, line;
    while (std::getline(std::cin, header) && (header.empty() || header[0] == '#')) {
    }
    std::optional<LiveStreamEncoder> encoder;
    while (std::getline(std::cin, line)) {
        if (line.empty() || line[0] == '#') continue;
        const Motion row = parse_motion_csv(header + "\n" + line + "\n").motion;
        if (!encoder) {
            encoder.emplace(*model, row.time_s[0], row.at(0),
                            LiveOptions{options.stream.max_error_mm, options.look_ahead_s, 1});
            send(encoder->head());
        }
        send(encoder->push(row.time_s[0], row.at(0)));
    }
    if (!encoder) throw InputError("motion", "no row", "a header and rows of motion on stdin");
    send(encoder->finish());
    return 0;
}

}  // namespace

Command add_via_encode(CLI::App& via) {
    auto options = std::make_shared<Options>();
    CLI::App* app =
        via.add_subcommand("encode", "A motion as a stream of via points, within a bound, in few bits.");
    app->add_option("motion", options->motion, "motion CSV in mm; - with --live: rows on stdin")->required();
    app->add_option("-o,--output", options->output, "the stream, .via; packets of --live go to stdout");
    app->add_option("--max-error", options->stream.max_error_mm,
                    "bound in mm for each point at each sample, 0.01 to 100")
        ->capture_default_str();
    app->add_option("--talker", options->talker,
                    std::string("whose basis and statistics are used, ") + kStreamTalkerHelp +
                        "; when absent the basis stands in the stream");
    app->add_option("--model", options->model, "a stream model's file in place of --talker");
    app->add_option("--sync", options->stream.sync_s, "s, at most, between sync points, 0.2 to 60")
        ->capture_default_str();
    app->add_option("--phones", options->phones, "TextGrid whose phones travel along");
    app->add_flag("--live", options->live, "rows on stdin, packets on stdout as they fall due");
    app->add_option("--look-ahead", options->look_ahead_s, "s that --live may wait, 0.1 to 10")
        ->capture_default_str();
    return [options] {
        if (options->live != (options->motion == "-"))
            throw InputError("motion", options->motion, "- with --live, else a file");
        if (options->live != options->output.empty())
            throw InputError("output", options->output, "a file to write; none with --live");
        return options->live ? encode_live(*options) : encode_file(*options);
    };
}

}  // namespace viaface
