#include "synth/talker/talker.hpp"

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "viapoints/codex_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 256u << 20;

}  // namespace

nlohmann::json read_talker_json(const fs::path& folder) {
    const fs::path file = folder / "talker.json";
    if (!fs::exists(file)) throw InputError("talker", folder.string(), "a folder with a talker.json");
    try {
        auto description = nlohmann::json::parse(read_text(file, "talker"));
        description.at("name").get_ref<const std::string&>();
        description.at("provenance").at("motion").get_ref<const std::string&>();
        if (description.contains("voice")) description.at("voice").get_ref<const std::string&>();
        return description;
    } catch (const nlohmann::json::exception& error) {
        throw InputError("talker", file.string(),
                         std::string("a talker's description in JSON: ") + error.what());
    }
}

Talker load_talker(const fs::path& folder, Textures textures) {
    const auto bytes_of = [&](const char* name) { return read_bytes(folder / name, "talker", kLargestFile); };
    auto description = read_talker_json(folder);
    Face face = read_glb(bytes_of("face.glb"), textures);
    Poser poser(face, read_training(bytes_of("estimators.bin")));
    return {std::move(description), std::move(face), read_codex(bytes_of("codex.via")), std::move(poser)};
}

nlohmann::json talker_description(const std::string& name, const std::string& summary) {
    return {{"name", name},
            {"summary", summary},
            {"format", 1},
            {"units",
             "mm and s, head frame: x to the talker's left, y up, z forward, origin midway between the upper "
             "incisors' edges at rest"},
            {"layout", "viapoints/LAYOUT.md, 38 points"},
            {"language", "en"},
            {"files", {{"face", "face.glb"}, {"estimators", "estimators.bin"}, {"codex", "codex.via"}}}};
}

}  // namespace viaface
