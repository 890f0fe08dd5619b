#include "synth/speech/flite_diphones.hpp"

#include <flite/flite.h>

#include <algorithm>
#include <array>
#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

#include "viapoints/phones.hpp"

extern "C" {
#include <flite/cst_diphone.h>

extern const cst_diphone_db cmu_us_kal16_db;
}

namespace viaface {
namespace {

using Neighbour = std::pair<std::string_view, std::string_view>;
constexpr std::array<Neighbour, 3> kInFront = {{{"hh", "th"}, {"w", "uw"}, {"y", "iy"}}};
constexpr std::array<Neighbour, 1> kBehind = {{{"ng", "n"}}};

std::string_view neighbour(std::span<const Neighbour> table, std::string_view phone) {
    const auto found = std::ranges::find(table, phone, &Neighbour::first);
    return found == table.end() ? phone : found->second;
}

std::string pair_of(std::string_view first, std::string_view second) {
    return std::string(first) + "-" + std::string(second);
}

std::span<const cst_diphone_entry> own_diphones() {
    return {cmu_us_kal16_db.diphones, static_cast<std::size_t>(cmu_us_kal16_db.num_entries)};
}

bool named_before(const cst_diphone_entry& entry, std::string_view name) { return entry.name < name; }

const cst_diphone_entry* own_diphone(std::string_view name) {
    const auto own = own_diphones();
    const auto found = std::lower_bound(own.begin(), own.end(), name, named_before);
    return found != own.end() && found->name == name ? &*found : nullptr;
}

struct Whole {
    std::deque<std::string> names;  // of what the voice lacks
    std::vector<cst_diphone_entry> entries;
    cst_diphone_db db = cmu_us_kal16_db;

    Whole() {
        const auto own = own_diphones();
        entries.assign(own.begin(), own.end());
        for (const PhoneInfo& first : phone_table()) {
            for (const PhoneInfo& second : phone_table()) add(first.name, second.name);
        }
        std::ranges::sort(entries, {}, [](const auto& entry) { return std::string_view(entry.name); });
        db.num_entries = static_cast<int>(entries.size());
        db.diphones = entries.data();
    }

  private:
    void add(std::string_view first, std::string_view second) {
        const auto stand_in = diphone_in_place_of(first, second);
        if (!stand_in) return;
        entries.push_back(*own_diphone(*stand_in));
        entries.back().name = names.emplace_back(pair_of(first, second)).c_str();
    }
};

}  // namespace

std::optional<std::string> diphone_in_place_of(std::string_view first, std::string_view second) {
    if (own_diphone(pair_of(first, second))) return std::nullopt;
    const std::string_view like_first = neighbour(kInFront, first), like_second = neighbour(kBehind, second);
    for (const auto& [a, b] :
         {std::pair(like_first, second), {first, like_second}, {like_first, like_second}}) {
        if (own_diphone(pair_of(a, b))) return pair_of(a, b);
    }
    throw std::logic_error("no diphone stands in for " + pair_of(first, second));
}

const cst_diphone_db& whole_diphones() {
    static const Whole whole;
    return whole.db;
}

}  // namespace viaface
