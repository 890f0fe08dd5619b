#include "server/bench_via.hpp"

#include <atomic>
#include <cstdio>
#include <functional>
#include <future>

#include "base/error.hpp"
#include "synth/stream/baselines.hpp"
#include "synth/stream/bench_motions.hpp"
#include "synth/talker/stream_models.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "viapoints/stream_train.hpp"
#include "viapoints/via_stream.hpp"

namespace viaface {
namespace {

constexpr double kBaselineShare = 0.4;  // of the bound, that a baseline's components may leave

struct Row {
    std::string name;
    double bound_mm = 0;
    StreamAccount stream;
    BaselineBits dct, xz;
    std::string not_reached;  // why, when the bound was not
};

double per_second(double bits, const Row& row) { return bits / row.stream.seconds; }

void tell(const std::string& motion, double bound_mm, const char* step) {
    std::fprintf(stderr, "%s, %g mm: %s\n", motion.c_str(), bound_mm, step);
}

// The very motion's, in the baselines' favour.
ConfigurationBasis baseline_basis(const RowMatrix& positions, double bound_mm) {
    constexpr Eigen::Index kFewest = 10;
    ConfigurationBasis basis = principal_basis(positions, kCoordinates);
    Eigen::Index modes = std::min(kFewest, basis.size());
    const auto leading = [&] { return ConfigurationBasis{basis.mean, basis.modes.leftCols(modes)}; };
    while (modes < basis.size() && truncation_error_mm(leading(), positions) > kBaselineShare * bound_mm)
        ++modes;
    return leading();
}

Row measured(const BenchMotion& motion, const Motion& training, const StreamModel* model, double bound_mm) {
    tell(motion.name, bound_mm, "searching its via points");
    Row row{motion.name, bound_mm, encode_stream(motion.motion, model, {.max_error_mm = bound_mm}).account,
            {},          {},       {}};
    tell(motion.name, bound_mm, "searching the baselines");
    const ConfigurationBasis own = baseline_basis(motion.motion.positions, bound_mm);
    row.dct = dct_bits(motion.motion, training, own, bound_mm);
    row.xz = delta_xz_bits(motion.motion, own, bound_mm);
    return row;
}

void print_heading() {
    std::printf("%-16s %6s %9s %9s %7s %7s | %9s %7s %7s | %9s\n", "motion", "bound", "payload", "whole",
                "rms", "max", "DCT", "rms", "times", "xz");
    std::printf("%-16s %6s %9s %9s %7s %7s | %9s %7s %7s | %9s\n", "", "mm", "bit/s", "bit/s", "mm", "mm",
                "bit/s", "mm", "payload", "bit/s");
}

void print(const Row& row) {
    if (!row.not_reached.empty()) {
        std::printf("%-16s %6.2f not reached: %s\n", row.name.c_str(), row.bound_mm, row.not_reached.c_str());
        std::fflush(stdout);
        return;
    }
    const double payload = per_second(8.0 * static_cast<double>(row.stream.payload_bytes), row),
                 dct = per_second(row.dct.bits, row);
    std::printf("%-16s %6.2f %9.1f %9.1f %7.3f %7.3f | %9.1f %7.3f %7.2f | %9.1f\n", row.name.c_str(),
                row.bound_mm, payload, per_second(8.0 * static_cast<double>(row.stream.all_bytes), row),
                row.stream.rms_error_mm, row.stream.max_error_mm, dct, row.dct.rms_error_mm, dct / payload,
                per_second(row.xz.bits, row));
    std::fflush(stdout);
}

void describe(const BenchMotion& motion) {
    const MotionRange range = range_of(motion.motion);
    std::printf(
        "%s: %.1f s, a point moves over 10 mm/s in %.0f%% of samples; range %.1f mm at most, %.1f mm in the "
        "mean of points\n",
        motion.name.c_str(), motion.motion.time_s.back() - motion.motion.time_s.front(),
        100 * active_share(motion.motion), range.largest_mm, range.mean_mm);
}

// Statistics and basis from the other take, and the basis from the talker's shapes.
Row phrase_row(const BenchMotion& take, const BenchMotion& other, const RowMatrix& shapes, double bound_mm) {
    tell(take.name, bound_mm, "learning from the other take");
    const StreamModel model =
        learn_stream_model("bench", {other.motion}, {.bounds_mm = {bound_mm}, .also = shapes});
    return measured(take, other.motion, &model, bound_mm);
}

using RowToCome = std::packaged_task<Row()>;

RowToCome row_to_come(const BenchMotion& motion, double bound_mm, std::function<Row()> row) {
    return RowToCome([&motion, bound_mm, row = std::move(row)] {
        try {
            return row();
        } catch (const InputError& error) {
            return Row{motion.name, bound_mm, {}, {}, {}, error.what()};
        }
    });
}

// Two rows at a time; each is printed when it and all before it are there.
void print_rows(std::vector<RowToCome>& rows) {
    std::vector<std::future<Row>> measured;
    for (RowToCome& row : rows) measured.push_back(row.get_future());
    std::atomic<std::size_t> next = 0;
    const auto measure = [&] {
        for (std::size_t i = next++; i < rows.size(); i = next++) rows[i]();
    };
    const auto first = std::async(std::launch::async, measure),
               second = std::async(std::launch::async, measure);
    for (auto& row : measured) print(row.get());
}

int run(const std::string& name, const std::filesystem::path& data, bool full) {
    const auto talker = TalkerShelf(talkers_folder()).load(name);
    const BenchMotions motions = bench_motions(*talker, data);
    for (const std::string& skipped : motions.skipped) std::printf("skipped: %s\n", skipped.c_str());
    std::printf(
        "Payload: range-coded via points alone. Whole: every byte of the file, sync points at most 10 s "
        "apart, the talker named. Basis and statistics are the\n"
        "talker's and not counted: for each phrase take they come from the other one and the talker's named "
        "shapes, for the rest from stream.bin. DCT and xz: payload\n"
        "alone, with the ten leading components of the very motion or as many as leave 0.4 of the bound, "
        "searched to the same largest error; the DCT's contexts are primed on the other take, else on the "
        "very motion.\n");
    for (const BenchMotion& motion : motions.phrase_takes) describe(motion);
    for (const BenchMotion& motion : motions.others) describe(motion);
    print_heading();
    const RowMatrix shapes = shape_positions(*talker);
    const auto model = find_stream_model(talkers_folder() / name);
    const std::vector<double> bounds =
        full ? std::vector<double>{0.25, 0.5, 1, 2, 4} : std::vector<double>{1};
    const auto& takes = motions.phrase_takes;
    std::vector<RowToCome> rows;
    for (const double bound : bounds) {
        for (std::size_t i = 0; i < takes.size(); ++i)
            rows.push_back(row_to_come(takes[i], bound, [&, i, bound] {
                return phrase_row(takes[i], takes[1 - i], shapes, bound);
            }));
        if (!full && !takes.empty()) continue;
        for (const BenchMotion& motion : motions.others)
            rows.push_back(row_to_come(motion, bound, [&, bound] {
                return measured(motion, motion.motion, model ? &*model : nullptr, bound);
            }));
    }
    print_rows(rows);
    return 0;
}

}  // namespace

Command add_bench_via(CLI::App& bench) {
    struct Options {
        std::string talker = "momo", data;
        bool full = false;
    };
    auto options = std::make_shared<Options>();
    options->data = (talkers_folder() / ".." / ".." / "shared" / "data").lexically_normal().string();
    CLI::App* app = bench.add_subcommand(
        "via", "Bits of via-point streams on real motion, beside DCT and xz at the same largest error.");
    app->add_option("--talker", options->talker, "a built-in talker's name")->capture_default_str();
    app->add_option("--data", options->data, "folder with facegood/, livelink_rom/ and haskins_f01/")
        ->capture_default_str();
    app->add_flag("--full", options->full, "0.25 to 4 mm, and every motion");
    return [options] { return run(options->talker, options->data, options->full); };
}

}  // namespace viaface
