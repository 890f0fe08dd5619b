// Two programs in a row, as two people would use them: one tells motion as it happens, the other draws it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <queue>
#include <thread>

#include "synth/film/media_reader.hpp"
#include "synth/stream/bench_motions.hpp"
#include "synth/talker/stream_models.hpp"
#include "tests/scratch_folder.hpp"
#include "viapoints/measured.hpp"
#include "viapoints/motion_csv.hpp"
#include "viapoints/via_stream_live.hpp"

namespace viaface {
namespace {

using Clock = std::chrono::steady_clock;

const std::string kTalker = std::string(VIAFACE_SOURCE_DIR) + "/talkers/momo";

// The program with a pipe at each end; killed if it still runs when this goes.
class PipedProgram {
  public:
    explicit PipedProgram(const std::vector<std::string>& arguments) {
        std::array<int, 2> to{}, from{};
        if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe");
        std::vector<char*> argv{const_cast<char*>(VIAFACE_PROGRAM)};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        process_ = fork();
        if (process_ == 0) {
            if (dup2(to[0], STDIN_FILENO) < 0 || dup2(from[1], STDOUT_FILENO) < 0) _exit(126);
            execv(VIAFACE_PROGRAM, argv.data());
            _exit(127);
        }
        close(to[0]);
        close(from[1]);
        in_ = to[1];
        out_ = from[0];
        if (process_ < 0) throw std::runtime_error("fork failed");
    }
    ~PipedProgram() {
        close_input();
        close(out_);
        if (process_ <= 0) return;
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    PipedProgram(const PipedProgram&) = delete;
    PipedProgram& operator=(const PipedProgram&) = delete;

    bool write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(in_, bytes.data(), bytes.size());
            if (written <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
        return true;
    }
    std::string read() {  // what is there; empty at the end
        std::string bytes(65536, '\0');
        const ssize_t got = ::read(out_, bytes.data(), bytes.size());
        bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        return bytes;
    }
    void close_input() {
        if (in_ >= 0) close(in_);
        in_ = -1;
    }
    int status() {
        int status = 0;
        waitpid(process_, &status, 0);
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t process_ = -1;
    int in_ = -1, out_ = -1;
};

// The talker's own motion, as far apart in time as it was.
Motion spoken() { return spoken_motion(load_talker(kTalker), {"My mother bought a boat."}); }

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// What passed between the programs, and when.
struct Passed {
    double at_s = 0;
    std::string bytes;
};

// From one program to the other, each read so much later.
std::vector<Passed> delayed(PipedProgram& from, PipedProgram& to, Clock::time_point start, double delay_s) {
    std::vector<Passed> passed;
    for (std::string bytes = from.read(); !bytes.empty(); bytes = from.read()) {
        passed.push_back({since(start) + delay_s, bytes});
        std::this_thread::sleep_until(start + std::chrono::duration<double>(passed.back().at_s));
        EXPECT_TRUE(to.write(bytes));
    }
    to.close_input();
    return passed;
}

// How long after it happened a row could be drawn, by what had passed: mean and largest.
std::pair<double, double> latency(const std::vector<Passed>& passed, const StreamModel& model) {
    LiveStreamDecoder decoder({&model}, 100);
    double sum = 0, largest = 0;
    std::size_t rows = 0;
    for (const Passed& one : passed) {
        for (const double time :
             decoder.feed({reinterpret_cast<const std::uint8_t*>(one.bytes.data()), one.bytes.size()})
                 .time_s) {
            sum += one.at_s - time;
            largest = std::max(largest, one.at_s - time);
            ++rows;
        }
    }
    return {sum / static_cast<double>(std::max<std::size_t>(rows, 1)), largest};
}

TEST(LivePipe, MotionIsToldAndDrawnAsItHappens) {
    constexpr double kDelay = 0.1;
    signal(SIGPIPE, SIG_IGN);
    const test::ScratchFolder folder;
    const Motion motion = spoken();
    PipedProgram teller({"via", "encode", "--live", "-", "--talker", "momo", "--look-ahead", "0.4"});
    PipedProgram drawer(
        {"render", "-", "-o", (folder / "film.mkv").string(), "--size", "64x64", "--fps", "25", "--quiet"});
    const std::string csv = format_motion_csv(motion);
    const Clock::time_point start = Clock::now();
    std::thread happening([&] {
        std::size_t line = 0, begin = 0;
        for (std::size_t end = csv.find('\n'); end != csv.npos; end = csv.find('\n', begin)) {
            const std::string_view text(csv.data() + begin, end + 1 - begin);
            const bool row = text[0] != '#' && text[0] != 't';
            if (row)
                std::this_thread::sleep_until(start + std::chrono::duration<double>(motion.time_s[line++]));
            if (!teller.write(text)) break;
            begin = end + 1;
        }
        teller.close_input();
    });
    const std::vector<Passed> passed = delayed(teller, drawer, start, kDelay);
    happening.join();
    EXPECT_EQ(drawer.read(), "");
    EXPECT_EQ(drawer.status(), 0);
    const double whole = since(start);
    EXPECT_EQ(teller.status(), 0);

    const StreamModel model = load_stream_model(kTalker);
    const auto [mean, largest] = latency(passed, model);
    std::printf(
        "latency of a row at the drawing program: mean %.3f s, at most %.3f s, of look-ahead 0.4 s and "
        "delay %.1f s; the film whole %.3f s after the last row\n",
        mean, largest, kDelay, whole - motion.time_s.back());
    std::string stream;
    for (const Passed& one : passed) stream += one.bytes;
    const StreamModel* const models[] = {&model};
    const DecodedStream decoded =
        decode_stream({reinterpret_cast<const std::uint8_t*>(stream.data()), stream.size()}, models);
    EXPECT_TRUE(decoded.damage.empty()) << decoded.describe_damage();
    EXPECT_GE(decoded.segments.size(), 5u);
    const RowMatrix off = decoded.positions(motion.time_s) - motion.positions;
    EXPECT_LE(longest_triple(coordinates_of(off, measured_points(motion.positions, "motion"))), 1);
    FrameReader frames(folder / "film.mkv");
    int count = 0;
    while (frames.next()) ++count;
    const double length_s = motion.time_s.back() - motion.time_s.front();
    constexpr double kSilenceAhead = 0.12;  // s, sent ahead by a live film and a frame, which it then shows
    EXPECT_GE(count, 25 * length_s);
    EXPECT_LE(count, 25 * (length_s + kSilenceAhead) + 1);
}

}  // namespace
}  // namespace viaface
