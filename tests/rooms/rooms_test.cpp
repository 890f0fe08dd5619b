// Holds the table of rooms in CONTRIBUTING.md: who may include whom, and which room each vendor lives in.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const std::map<std::string, Names> kMayInclude = {
    {"base", {"base"}},
    {"viapoints", {"base", "viapoints"}},
    {"facemodel", {"base", "facemodel"}},
    {"lipmodel", {"base", "lipmodel", "facemodel/mesh.hpp"}},
    {"synth", {"base", "viapoints", "facemodel", "lipmodel", "synth"}},
    {"server", {"base", "viapoints", "facemodel", "synth", "server", "web/web_files.hpp"}},
};

// Vendor header (prefix) -> the folders it may appear in.
const std::map<std::string, Names> kVendorRooms = {
    {"flite", {"synth/speech"}},
    {"libav", {"synth/film"}},
    {"libsw", {"synth/film"}},
    {"GL/", {"synth/picture"}},
    {"png.h", {"facemodel"}},
    {"httplib", {"server"}},
    {"CLI/", {"server"}},
    {"opencv2/", {"lipmodel", "synth/scans"}},
    {"pocketsphinx", {"synth/align"}},
    {"sphinxbase", {"synth/align"}},
    {"lzma", {"synth/stream"}},
};

struct Include {
    fs::path file;
    std::string name;
    bool ours;
};

std::vector<Include> includes_below(const fs::path& root, const std::string& room) {
    static const std::regex kPattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<Include> found;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
        if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
        std::ifstream in(entry.path());
        std::string line;
        std::smatch match;
        while (std::getline(in, line)) {
            if (!std::regex_search(line, match, kPattern)) continue;
            found.push_back({fs::relative(entry.path(), root), match[2], match[1] == "\""});
        }
    }
    return found;
}

std::string room_of(const std::string& path) { return path.substr(0, path.find('/')); }

bool starts_with_any(const std::string& path, const Names& prefixes) {
    for (const auto& prefix : prefixes) {
        if (path.rfind(prefix, 0) == 0) return true;
    }
    return false;
}

TEST(Rooms, IncludeOnlyWhomTheyMay) {
    const fs::path root = VIAFACE_SOURCE_DIR;
    std::size_t checked = 0;
    for (const auto& [room, allowed] : kMayInclude) {
        if (!fs::exists(root / room)) continue;
        for (const Include& include : includes_below(root, room)) {
            if (!include.ours) continue;
            ++checked;
            EXPECT_TRUE(allowed.contains(room_of(include.name)) || allowed.contains(include.name))
                << include.file << " includes " << include.name;
        }
    }
    EXPECT_GT(checked, 50u);
}

bool holds_sources(const fs::path& folder) {
    const auto found = fs::recursive_directory_iterator(folder);
    return std::any_of(begin(found), end(found), [](const fs::directory_entry& entry) {
        return entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp";
    });
}

TEST(Rooms, EveryFolderOfSourcesIsInTheTable) {
    const Names others = {"build", "fuzz", "tests",
                          "web"};  // made, or may include all; a file without includes
    for (const auto& entry : fs::directory_iterator(VIAFACE_SOURCE_DIR)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_directory() || name.front() == '.' || others.contains(name)) continue;
        EXPECT_TRUE(kMayInclude.contains(name) || !holds_sources(entry.path())) << name;
    }
}

TEST(Rooms, VendorsStayInTheirRooms) {
    const fs::path root = VIAFACE_SOURCE_DIR;
    for (const auto& [room, allowed] : kMayInclude) {
        if (!fs::exists(root / room)) continue;
        for (const Include& include : includes_below(root, room)) {
            for (const auto& [vendor, rooms] : kVendorRooms) {
                if (include.ours || include.name.rfind(vendor, 0) != 0) continue;
                EXPECT_TRUE(starts_with_any(include.file.generic_string(), rooms))
                    << include.file << " includes <" << include.name << ">";
            }
        }
    }
}

// What makes talkers is linked by programs of its own.
const Names kMakers = {"synth/training", "synth/scans"};

TEST(Rooms, WhatMakesTalkersStaysOutOfWhatSpeaks) {
    const fs::path root = VIAFACE_SOURCE_DIR;
    for (const auto& [room, allowed] : kMayInclude) {
        if (!fs::exists(root / room)) continue;
        for (const Include& include : includes_below(root, room)) {
            const std::string file = include.file.generic_string();
            if (starts_with_any(file, kMakers) || file.rfind("server/train", 0) == 0) continue;
            EXPECT_FALSE(starts_with_any(include.name, kMakers)) << file << " includes " << include.name;
        }
    }
}

}  // namespace
