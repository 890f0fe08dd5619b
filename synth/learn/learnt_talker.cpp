#include "synth/learn/learnt_talker.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/whole_file.hpp"
#include "synth/talker/talker.hpp"
#include "viapoints/codex_consensus.hpp"
#include "viapoints/codex_file.hpp"
#include "viapoints/measured.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

std::string listed(const std::vector<std::string>& names, std::size_t most) {
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) list += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? list + " and " + std::to_string(names.size() - most) + " more" : list;
}

double seconds_of(const RecordedTake& read) {
    return read.take.phones.end_s(read.take.phones.phones.size() - 1) - read.take.phones.begin_s(0);
}

nlohmann::json recordings_of(const RecordedTakes& takes) {
    nlohmann::json list = nlohmann::json::array();
    for (const RecordedTake& read : takes.takes) {
        list.push_back({{"name", read.take.name},
                        {"seconds", std::round(seconds_of(read) * 1000) / 1000},
                        {"phones", read.aligned ? "aligned" : "labelled"},
                        {"confidence", std::round(read.confidence * 1000) / 1000}});
    }
    return list;
}

std::string provenance_of(const RecordedTakes& takes) {
    std::vector<std::string> names;
    for (const RecordedTake& read : takes.takes) names.push_back(read.take.name);
    const auto points = measured_points(takes.takes.front().take.motion.positions, "motion").size();
    return "Learned from " + std::to_string(names.size()) + " recordings of " + std::to_string(points) +
           " points: " + listed(names, 8) + ".";
}

nlohmann::json description_of(const RecordedTakes& takes, const nlohmann::json& base,
                              const std::string& name) {
    nlohmann::json description = base;
    description["name"] = name;
    description["summary"] = "the face of " + base.at("name").get<std::string>() +
                             ", with motion learned from " + std::to_string(takes.takes.size()) +
                             " recordings";
    description["provenance"]["motion"] = provenance_of(takes);
    description["provenance"]["recordings"] = recordings_of(takes);
    description["provenance"].erase("corpus");
    return description;
}

}  // namespace

LearntTalker make_talker(const RecordedTakes& takes, const fs::path& base, const fs::path& folder,
                         const LearningOptions& options) {
    const auto described = read_talker_json(base);
    WholeFolder whole(folder);
    std::vector<const Take*> all;
    for (const RecordedTake& read : takes.takes) all.push_back(&read.take);
    LearntTalker talker{learn_from_takes(
                            basis_of(all, options.basis_error_mm), takes.rest, all.size(),
                            [&](std::size_t i) { return *all[i]; }, provenance_of(takes), options),
                        {},
                        {}};
    talker.learnt.codex = with_scatter(std::move(talker.learnt.codex));
    talker.coverage = coverage_of(talker.learnt.codex);
    talker.shares = shares_by_others(talker.learnt.codex);
    for (const char* part : {"face.glb", "estimators.bin"}) {
        const Bytes bytes = read_bytes(base / part, "--talker");
        write_whole(whole.path() / part, std::span(bytes));
    }
    const Bytes codex = write_codex(talker.learnt.codex);
    write_whole(whole.path() / "codex.via", std::span(codex));
    const std::string name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
    write_whole(whole.path() / "talker.json",
                std::string_view(description_of(takes, described, name).dump(2) + "\n"));
    whole.commit();
    return talker;
}

std::string as_text(const LearntTalker& talker) {
    constexpr std::size_t kListed = 24;
    char line[240];
    std::string text;
    for (const std::string& dropped : talker.learnt.dropped) text += "left out: " + dropped + "\n";
    text += summary(talker.learnt) + "\n";
    const Coverage& c = talker.coverage;
    std::snprintf(line, sizeof line,
                  "%zu units: %d phones, %d diphones, %d triphones; %zu phones and %zu diphones missing\n",
                  talker.learnt.codex.units.size(), c.phones, c.diphones, c.triphones,
                  c.missing_phones.size(), c.missing_diphones.size());
    text += line;
    if (!c.missing_phones.empty()) text += "phones missing: " + listed(c.missing_phones, kListed) + "\n";
    std::snprintf(
        line, sizeof line,
        "each recording by units of the others: %.1f%% exact triphones, %.1f%% by viseme class, %.1f%% "
        "halves or stand-ins\n",
        100 * talker.shares.exact, 100 * talker.shares.of_class, 100 * talker.shares.half);
    return text + line;
}

}  // namespace viaface
