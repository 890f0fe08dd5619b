#include "synth/learn/take_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

std::string ending(const fs::path& file) {
    std::string text = file.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

// The part of a take that a file is, by its ending; none for other files.
fs::path* part_of(TakeFiles& take, const std::string& ending) {
    if (ending == ".csv" || ending == ".c3d" || ending == ".trc" || ending == ".via") return &take.motion;
    if (ending == ".wav" || ending == ".flac") return &take.sound;
    if (ending == ".textgrid") return &take.labels;
    if (ending == ".txt") return &take.transcript;
    return nullptr;
}

std::vector<fs::path> files_of(const fs::path& folder, const std::string& field) {
    if (!fs::is_directory(folder)) throw InputError(field, folder.string(), "a folder of recordings");
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void check_whole(const TakeFiles& take, const std::string& field) {
    const auto need = [&](bool there, const char* what) {
        if (!there)
            throw InputError(field, take.name + ": no " + what, "motion, sound and words of every take");
    };
    need(!take.motion.empty(), "motion (.csv, .c3d, .trc or .via)");
    need(!take.sound.empty(), "sound (.wav or .flac)");
    need(!take.labels.empty() || !take.transcript.empty(), "words (.txt or .TextGrid)");
}

void check_apart(const std::vector<TakeFiles>& takes, const std::string& field) {
    std::map<std::uint64_t, std::string> seen;
    for (const TakeFiles& take : takes) {
        const auto [same, is_new] = seen.emplace(fnv1a(read_bytes(take.motion, field)), take.name);
        if (!is_new) {
            throw InputError(field, take.motion.filename().string() + " is the motion of " + same->second,
                             "every take once");
        }
    }
}

}  // namespace

std::vector<TakeFiles> find_takes(const fs::path& folder, const std::string& field) {
    std::map<std::string, TakeFiles> by_name;
    for (const fs::path& file : files_of(folder, field)) {
        TakeFiles none;
        if (!part_of(none, ending(file))) continue;
        TakeFiles& take = by_name[file.stem().string()];
        take.name = file.stem().string();
        fs::path* part = part_of(take, ending(file));
        if (!part->empty()) {
            throw InputError(field, part->filename().string() + " and " + file.filename().string(),
                             "one file for each part of a take");
        }
        *part = file;
    }
    std::vector<TakeFiles> takes;
    for (auto& [name, take] : by_name) {
        // A text that nothing else goes with is no take: notes, a licence.
        if (take.motion.empty() && take.sound.empty() && take.labels.empty()) continue;
        check_whole(take, field);
        takes.push_back(std::move(take));
    }
    if (takes.empty()) {
        throw InputError(field, folder.string(),
                         "a folder of recordings: NAME.csv, NAME.wav and NAME.txt or NAME.TextGrid of each");
    }
    check_apart(takes, field);
    return takes;
}

}  // namespace viaface
