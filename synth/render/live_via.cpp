#include "synth/render/live_via.hpp"

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr double kRate = 100;  // Hz
constexpr int kFirstByte = 0x89;

}  // namespace

LiveVia::LiveVia(std::istream& in, std::vector<const StreamModel*> models)
    : in_(in), decoder_(std::move(models), kRate) {}

void LiveVia::keep(const Motion& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows_.push_back({rows.time_s[i], rows.at(i)});
}

std::optional<LiveRow> LiveVia::next() {
    try {
        while (rows_.empty() && !ended_) {
            const int byte = in_.get();  // one by one: what is there must not wait for what is not
            ended_ = byte == std::istream::traits_type::eof();
            const auto one = static_cast<std::uint8_t>(byte);
            keep(ended_ ? decoder_.finish() : decoder_.feed({&one, 1}));
        }
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw InputError("motion", error.what(), "a whole head of a via-point stream");
    }
    if (rows_.empty()) return std::nullopt;
    LiveRow row = std::move(rows_.front());
    rows_.pop_front();
    return row;
}

std::string LiveVia::describe_damage() const {
    return decoder_.decoded() ? decoder_.decoded()->describe_damage() : std::string();
}

bool begins_via(std::istream& in) { return in.peek() == kFirstByte; }

}  // namespace viaface
