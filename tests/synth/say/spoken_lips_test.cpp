// What the built-in talkers' lips do in sentences that they never recited, fifty of momo's and ten of each of
// the others', measured on the posed mesh after contact, at the frames of a film of 30 per second.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "synth/say/recital.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

constexpr double kFps = 30;

struct Drawn {
    std::array<double, 3> gaps;  // mm: middle, halfway to either corner
    double width;                // mm, corner to corner of the inner contour
    double to_teeth;             // mm, lower lip to the upper incisors' edge
};

// Least distance of the lower lip's nodes from the edge of the upper incisors, both as drawn.
double lip_to_incisors(const Face& face, const Nodes& posed) {
    constexpr double kMiddle = 8, kEdge = 0.8;  // mm
    const auto teeth = std::find_if(face.parts.begin(), face.parts.end(),
                                    [](const auto& part) { return part.name == "teeth_upper"; });
    std::vector<Eigen::RowVector3d> edge;
    double lowest = 1e9;
    for (int i = teeth->first_node; i < teeth->first_node + teeth->nodes; ++i) {
        if (std::abs(posed(i, 0)) < kMiddle) lowest = std::min(lowest, posed(i, 1));
    }
    for (int i = teeth->first_node; i < teeth->first_node + teeth->nodes; ++i) {
        if (std::abs(posed(i, 0)) < kMiddle && posed(i, 1) < lowest + kEdge) edge.push_back(posed.row(i));
    }
    double least = 1e9;
    for (int row = 0; row < LipGrid::kRows; ++row) {
        for (int column = LipGrid::kColumns / 2 - 5; column <= LipGrid::kColumns / 2 + 5; ++column) {
            const Eigen::RowVector3d node = posed.row(face.lips.node(row, column));
            for (const auto& tooth : edge) least = std::min(least, (node - tooth).norm());
        }
    }
    return least;
}

Drawn measure(const Talker& talker, const Configuration& commanded) {
    const Nodes posed = talker.poser.posed(commanded);
    const auto inner = [&](int column) {
        return posed(talker.face.lips.node(LipGrid::kRows - 1, column), 0);
    };
    return {talker.poser.drawn_gaps(posed), inner(LipGrid::kColumns / 4) - inner(3 * LipGrid::kColumns / 4),
            lip_to_incisors(talker.face, posed)};
}

struct SpokenPhone {
    std::string name;  // with the sentence it is in
    VisemeClass viseme;
    std::string_view phone;
    int stress;
    std::vector<Drawn> frames;  // those shown during the phone, or the nearest one
};

std::vector<std::string> held_out(std::size_t every) {
    std::ifstream in(fs::path(VIAFACE_SOURCE_DIR) / "tests/synth/training/held_out.txt");
    std::vector<std::string> sentences;
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (count++ % every == 0) sentences.push_back(line);
    }
    return sentences;
}

void add_phones(std::vector<SpokenPhone>& spoken, const Talker& talker, const std::string& line) {
    SpeechRequest request;
    request.text = line;
    const Recital recital = recite(talker.codex, Script(request).utterance(0));
    const PhoneSequence& phones = recital.utterance.phones;
    for (std::size_t i = 0; i < phones.phones.size(); ++i) {
        const PhoneInfo& info = phone_info(phones.phones[i].phone);
        SpokenPhone said{
            std::string(info.name) + " in: " + line, info.viseme, info.name, phones.phones[i].stress, {}};
        auto first = static_cast<int>(std::ceil(phones.begin_s(i) * kFps)),
             last = static_cast<int>(std::floor(phones.end_s(i) * kFps));
        if (first > last)
            first = last = static_cast<int>(std::lround((phones.begin_s(i) + phones.end_s(i)) / 2 * kFps));
        for (int n = first; n <= last; ++n)
            said.frames.push_back(measure(talker, recital.motion.at(n / kFps)));
        spoken.push_back(std::move(said));
    }
}

struct Speaker {
    const char* name;
    std::size_t every;  // sentence of the fifty

    friend void PrintTo(const Speaker& speaker, std::ostream* out) { *out << speaker.name; }
};

const std::vector<SpokenPhone>& spoken_phones(const Speaker& speaker) {
    static std::map<std::string, std::vector<SpokenPhone>> all;
    std::vector<SpokenPhone>& spoken = all[speaker.name];
    if (!spoken.empty()) return spoken;
    const Talker talker = load_talker(fs::path(VIAFACE_SOURCE_DIR) / "talkers" / speaker.name);
    for (const std::string& line : held_out(speaker.every)) add_phones(spoken, talker, line);
    return spoken;
}

class SpokenLips : public testing::TestWithParam<Speaker> {
  protected:
    static const std::vector<SpokenPhone>& phones() { return spoken_phones(GetParam()); }
    static int at_least(int of_fifty) { return of_fifty / static_cast<int>(GetParam().every); }
};

double least_gap(const SpokenPhone& phone) {
    double least = 1e9;  // over frames, of the widest of the three places
    for (const Drawn& drawn : phone.frames)
        least = std::min(least, *std::max_element(drawn.gaps.begin(), drawn.gaps.end()));
    return least;
}

TEST_P(SpokenLips, CloseInEveryBilabial) {
    int count = 0;
    double worst = 0;
    for (const SpokenPhone& phone : phones()) {
        if (phone.viseme != VisemeClass::kBilabial) continue;
        ++count;
        worst = std::max(worst, least_gap(phone));
        EXPECT_LT(least_gap(phone), 0.5) << phone.name;
    }
    std::printf("%d p, b, m: widest gap %.3f mm\n", count, worst);
    EXPECT_GE(count, at_least(100));
}

TEST_P(SpokenLips, NeverPassThroughEachOther) {
    double deepest = 0;
    for (const SpokenPhone& phone : phones()) {
        for (const Drawn& drawn : phone.frames)
            deepest = std::min(deepest, *std::min_element(drawn.gaps.begin(), drawn.gaps.end()));
    }
    std::printf("deepest interpenetration %.4f mm\n", -deepest);
    EXPECT_GE(deepest, -1e-6);
}

TEST_P(SpokenLips, OpenInStressedOpenVowels) {
    double least = 1e9;
    int count = 0;
    for (const SpokenPhone& phone : phones()) {
        if (phone.viseme != VisemeClass::kOpen || phone.stress != 1) continue;
        double most = 0;
        for (const Drawn& drawn : phone.frames) most = std::max(most, drawn.gaps[0]);
        least = std::min(least, most);
        ++count;
        EXPECT_GT(most, 8) << phone.name;
    }
    std::printf("%d stressed open vowels: least opening %.2f mm\n", count, least);
    EXPECT_GE(count, at_least(50));
}

TEST_P(SpokenLips, AreNarrowerInUThanInI) {
    double widest_u = 0, narrowest_i = 1e9;
    for (const SpokenPhone& phone : phones()) {
        if (phone.stress == 0) continue;
        double least = 1e9, most = 0;
        for (const Drawn& drawn : phone.frames) {
            least = std::min(least, drawn.width);
            most = std::max(most, drawn.width);
        }
        if (phone.phone == "uw") widest_u = std::max(widest_u, least);
        if (phone.phone == "iy") narrowest_i = std::min(narrowest_i, most);
    }
    std::printf("stressed /u/ at most %.1f mm wide, /i/ at least %.1f mm\n", widest_u, narrowest_i);
    EXPECT_GT(narrowest_i - widest_u, 4);
}

TEST_P(SpokenLips, TouchTheIncisorsInEveryFAndV) {
    double worst = 0;
    int count = 0;
    for (const SpokenPhone& phone : phones()) {
        if (phone.viseme != VisemeClass::kLabiodental) continue;
        double least = 1e9;
        for (const Drawn& drawn : phone.frames) least = std::min(least, drawn.to_teeth);
        worst = std::max(worst, least);
        ++count;
        EXPECT_LT(least, 1) << phone.name;
    }
    std::printf("%d f, v: lower lip at most %.2f mm from the incisors' edge\n", count, worst);
    EXPECT_GE(count, at_least(30));
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, SpokenLips,
                         testing::Values(Speaker{"momo", 1}, Speaker{"amara", 5}, Speaker{"edwin", 5},
                                         Speaker{"sumi", 5}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace viaface
