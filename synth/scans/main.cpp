// viaface_adapt FOLDER OUTPUT LENDER: a talker of scans that nobody prepared, with what it lacks borrowed
// from the talker in the folder LENDER. A program of its own, so that detectors are not linked into what
// speaks.

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "facemodel/gltf.hpp"
#include "synth/scans/adaptation_to_scan.hpp"
#include "synth/scans/scan_paint.hpp"
#include "synth/talker/talker.hpp"
#include "viapoints/codex_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 256u << 20;

void print(const char* what, const FitDistances& d) {
    std::printf("%-34s %8.3f %8.3f %8.3f %8zu\n", what, d.mean, d.p95, d.largest, d.samples);
}

void print(const AdaptedHead& head) {
    for (const auto& remark : head.remarks) std::printf("%s\n", remark.c_str());
    for (const auto& part : head.completed)
        std::printf("completed from the generic head: %s\n", part.c_str());
    std::printf("the lips' corners stand %.1f mm higher than the generic head's%s\n", head.smile,
                head.smile > kSmile ? ": a smile, which stays" : "");
    std::printf("fit within the face, mm                mean      p95      max  samples\n");
    print("drawn surface to scan", head.to_scan);
    print("scan to drawn surface", head.from_surface);
    print("round the lips, drawn to scan", head.lips_to_scan);
    print("round the lips, scan to drawn", head.lips_from_surface);
    std::printf("triangles turned over: %d\n", head.flipped);
}

nlohmann::json as_json(const FitDistances& d) {
    return {{"mean_mm", d.mean}, {"p95_mm", d.p95}, {"max_mm", d.largest}, {"samples", d.samples}};
}

nlohmann::json postures_of(const BorrowedTalker& talker) {
    if (talker.own.empty()) return "Borrowed: the built-in talker's, by deformation transfer.";
    return {{"scanned", talker.own}, {"others", "borrowed: the built-in talker's, by deformation transfer"}};
}

nlohmann::json description(const std::string& name, const AdaptedHead& head, const ScanFolder& scans,
                           const BorrowedTalker& talker) {
    const Eigen::Vector3d& s = talker.motion_scale;
    auto told = talker_description(name, "made of a scan; the motion is borrowed from the built-in talker");
    told["provenance"] = {
        {"shape", "The generic head adapted to the scan " + scans.files.at("neutral") + "."},
        {"textures", head.scan.painted() ? "The scan's colours; painted by procedure where it has none."
                                         : "Painted by procedure; no photograph."},
        {"motion",
         "Borrowed: performed by a gestural model for the built-in talker, carried to this face by "
         "deformation transfer and scaled; not measured from a person."},
        {"postures", postures_of(talker)},
        {"motion_scale", {s.x(), s.y(), s.z()}},
        {"completed", head.completed},
        {"remarks", head.remarks}};
    told["fit"] = {{"drawn_to_scan", as_json(head.to_scan)},
                   {"scan_to_drawn", as_json(head.from_surface)},
                   {"lips_drawn_to_scan", as_json(head.lips_to_scan)},
                   {"lips_scan_to_drawn", as_json(head.lips_from_surface)},
                   {"turned_triangles", head.flipped},
                   {"lip_corners_above_generic_mm", head.smile}};
    told["licence"] = "as the scan's";
    return told;
}

int make(const fs::path& folder, const fs::path& output, const fs::path& lender_folder) {
    const fs::path place = fs::absolute(output / "").lexically_normal().parent_path();
    WholeFolder made(place);
    const ScanFolder scans = mirrored_back(read_scan_folder(folder));
    const GenericHead lender = generic_head(lender_folder);
    AdaptedHead head = adapt_head(lender, scans);
    const std::vector<OwnPosture> own = own_postures(lender, scans, head, head.remarks);
    print(head);
    const Codex codex = read_codex(read_bytes(lender_folder / "codex.via", "talker", kLargestFile));
    BorrowedTalker talker = with_borrowed_motion(lender, codex, head.nodes, head.mm_per_generic, own);
    std::fprintf(stderr, "viaface: %steeth, tongue, eyes and motion are borrowed from %s\n",
                 own.empty() ? "modes, lids, " : "postures that were not scanned, ",
                 lender_folder.filename().c_str());
    paint_from_scan(head, lender, talker);
    write_whole(made.path() / "face.glb", write_glb(talker.face, "as the scan's"));
    write_whole(made.path() / "estimators.bin", write_training(talker.training));
    write_whole(made.path() / "codex.via", write_codex(talker.codex));
    const std::string name = place.filename().string();
    write_whole(made.path() / "talker.json",
                std::string_view(description(name, head, scans, talker).dump(2) + "\n"));
    made.commit();
    return 0;
}

}  // namespace
}  // namespace viaface

int main(int argc, char** argv) {
    try {
        if (argc != 4) throw viaface::InputError("arguments", "", "FOLDER OUTPUT LENDER");
        return viaface::make(argv[1], argv[2], argv[3]);
    } catch (const viaface::InputError& error) {
        std::fprintf(stderr, "viaface: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "viaface: %s\n", viaface::describe(error).c_str());
        return 1;
    }
}
