#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "server/via_command.hpp"
#include "server/via_models.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {
namespace {

struct Options {
    std::string stream, output, talker, model;
    double rate_hz = 100;
    bool live = false;
};

// Rows at whole multiples of 1 / rate from the stream's start, where it tells them.
Motion rows_of(const DecodedStream& stream, double rate_hz) {
    Motion motion;
    for (std::int64_t n = 0; stream.head.start_s + static_cast<double>(n) / rate_hz <= stream.end_s() + 1e-9;
         ++n)
        motion.time_s.push_back(stream.head.start_s + static_cast<double>(n) / rate_hz);
    motion.positions = stream.positions(motion.time_s);
    return motion;
}

int decode_file(const Options& options) {
    const StreamModelsAtHand models(options.talker, options.model);
    const DecodedStream stream = decode_stream(read_stream_file(options.stream, models.all()), models.all());
    std::fputs(stream.describe_damage().c_str(), stderr);
    if (stream.segments.empty())
        throw InputError("stream", options.stream, "a stream with a segment that is whole");
    if (stream.end_s() - stream.begin_s() > 1e6 / options.rate_hz)
        throw InputError("rate", std::to_string(options.rate_hz), "a rate that gives at most 1000000 rows");
    write_motion_csv(options.output, rows_of(stream, options.rate_hz));
    return stream.damage.empty() ? 0 : 1;
}

// The header stands once, before the first rows.
void print_rows(const Motion& rows, bool& headed) {
    if (rows.time_s.empty()) return;
    const std::string text = format_motion_csv(rows);
    std::cout << (headed ? text.substr(text.find('\n') + 1) : text) << std::flush;
    headed = true;
}

int decode_live(const Options& options) {
    const StreamModelsAtHand models(options.talker, options.model);
    LiveStreamDecoder decoder(models.all(), options.rate_hz);
    std::array<std::uint8_t, 4096> buffer{};
    bool headed = false;
    for (;;) {
        const ssize_t got = read(STDIN_FILENO, buffer.data(), buffer.size());
        if (got < 0) throw std::runtime_error("stdin cannot be read");
        if (got == 0) break;
        print_rows(decoder.feed({buffer.data(), static_cast<std::size_t>(got)}), headed);
    }
    print_rows(decoder.finish(), headed);
    const std::string damage = decoder.decoded()->describe_damage();
    std::fputs(damage.c_str(), stderr);
    return damage.empty() ? 0 : 1;
}

}  // namespace

Command add_via_decode(CLI::App& via) {
    auto options = std::make_shared<Options>();
    CLI::App* app = via.add_subcommand("decode",
                                       "The motion of a stream of via points. Damage is named on stderr, "
                                       "what it spares is written; then the exit status is 1.");
    app->add_option("stream", options->stream, "the stream, .via; - with --live: packets on stdin")
        ->required();
    app->add_option("-o,--output", options->output, "motion CSV; rows of --live go to stdout");
    app->add_option("--rate", options->rate_hz, "rows per second, 1 to 1000")->capture_default_str();
    app->add_option(
        "--talker", options->talker,
        std::string("whose stream it is: ") + kStreamTalkerHelp + "; any built-in one when absent");
    app->add_option("--model", options->model, "a stream model's file, beside those of the talkers");
    app->add_flag("--live", options->live, "packets on stdin, rows on stdout as soon as they can be drawn");
    return [options] {
        if (!(options->rate_hz >= 1 && options->rate_hz <= 1000))
            throw InputError("rate", std::to_string(options->rate_hz), "1 to 1000");
        if (options->live != (options->stream == "-"))
            throw InputError("stream", options->stream, "- with --live, else a file");
        if (options->live != options->output.empty())
            throw InputError("output", options->output, "a file to write; none with --live");
        return options->live ? decode_live(*options) : decode_file(*options);
    };
}

}  // namespace viaface
