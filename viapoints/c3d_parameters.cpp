#include "viapoints/c3d_parameters.hpp"

#include <algorithm>
#include <cstdlib>

namespace viaface {
namespace {

std::string upper(std::string text) {
    for (char& c : text) {
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return text;
}

std::string without_padding(std::string text) {
    const std::size_t zero = std::min(text.find('\0'), text.size());
    text.resize(zero);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    return text;
}

struct Values {
    C3dParameter parameter;
    std::size_t end;  // in the file
};

Values read_values(const C3dBytes& bytes, std::size_t at, const std::string& name) {
    const int type = bytes.i8(at), dimensions = bytes.u8(at + 1);
    if ((type != -1 && type != 1 && type != 2 && type != 4) || dimensions > 7)
        bytes.fail("parameter " + name + " of type " + std::to_string(type) + " with " +
                       std::to_string(dimensions) + " dimensions",
                   "types -1, 1, 2 and 4, at most 7 dimensions");
    at += 2;
    std::size_t count = 1, width = 1;
    for (int d = 0; d < dimensions; ++d) {
        const std::size_t side = bytes.u8(at++);
        if (d == 0) width = side;
        count *= side;
        if (count > bytes.size())
            bytes.fail("parameter " + name + " with more values than the file", "fewer");
    }
    Values values{{}, at + count * static_cast<std::size_t>(std::abs(type))};
    if (values.end > bytes.size())
        bytes.fail("parameter " + name + " beyond the end of the file", "a whole file");
    if (type == -1) {
        for (std::size_t i = 0; width > 0 && i < count; i += width)
            values.parameter.texts.push_back(without_padding(bytes.text(at + i, width)));
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) {
        values.parameter.numbers.push_back(type == 1   ? bytes.u8(at + i)
                                           : type == 2 ? bytes.u16(at + 2 * i)
                                                       : bytes.f32(at + 4 * i));
    }
    return values;
}

}  // namespace

C3dParameters::C3dParameters(C3dBytes& bytes, std::size_t start) {
    const int processor = bytes.u8(start + 3);
    if (processor < 84 || processor > 86)
        bytes.fail("processor type " + std::to_string(processor) + " at byte " + std::to_string(start + 3),
                   "84 (Intel), 85 (DEC) or 86 (MIPS)");
    bytes.set_processor(static_cast<C3dProcessor>(processor));
    last_ = start;
    std::map<int, std::string> groups;
    struct Found {
        int group;
        std::string name;
        C3dParameter parameter;
    };
    std::vector<Found> found;
    for (std::size_t at = start + 4; at + 2 < bytes.size();) {
        const auto length = static_cast<std::size_t>(std::abs(static_cast<int>(bytes.i8(at))));
        const int number = bytes.i8(at + 1);
        if (length == 0 || number == 0) break;
        last_ = at;
        const std::string name = upper(bytes.text(at + 2, length));
        const std::size_t link = at + 2 + length, next = bytes.u16(link);
        if (number < 0) {
            groups[-number] = name;
        } else {
            found.push_back({number, name, read_values(bytes, link + 2, name).parameter});
        }
        if (next == 0) break;
        if (next < 2) bytes.fail("parameter " + name + " that links into itself", "a distance of at least 2");
        at = link + next;
    }
    for (Found& one : found) {
        const auto group = groups.find(one.group);
        const std::string prefix = group == groups.end() ? std::to_string(one.group) : group->second;
        all_.emplace(prefix + ":" + one.name, std::move(one.parameter));
    }
}

std::optional<double> C3dParameters::number(const std::string& name, std::size_t index) const {
    const auto found = all_.find(name);
    if (found == all_.end() || found->second.numbers.size() <= index) return std::nullopt;
    return found->second.numbers[index];
}

const std::vector<std::string>& C3dParameters::texts(const std::string& name) const {
    static const std::vector<std::string> kNone;
    const auto found = all_.find(name);
    return found == all_.end() ? kNone : found->second.texts;
}

}  // namespace viaface
