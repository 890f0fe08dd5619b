#include "synth/speech/wav.hpp"

#include <algorithm>
#include <string>

#include "base/error.hpp"

namespace viaface {
namespace {

constexpr std::size_t kHeader = 44, kFormat = 16;     // bytes
constexpr int kLeastRate = 1000, kMostRate = 384000;  // Hz

[[noreturn]] void refuse(const std::string& met) {
    throw InputError("sound", met, "a whole RIFF WAVE file of one channel of 16-bit PCM, 1000 to 384000 Hz");
}

std::string take_name(ByteReader& reader) {
    const auto name = reader.take(4);
    return {name.begin(), name.end()};
}

int read_format(ByteReader reader) {
    const auto tag = reader.get<std::uint16_t>(), channels = reader.get<std::uint16_t>();
    const auto rate = reader.get<std::uint32_t>();
    reader.take(6);
    const auto bits = reader.get<std::uint16_t>();
    if (tag != 1 || channels != 1 || bits != 16 || rate < kLeastRate || rate > kMostRate) {
        refuse("format " + std::to_string(tag) + ", " + std::to_string(channels) + " channels, " +
               std::to_string(bits) + " bits, " + std::to_string(rate) + " Hz");
    }
    return static_cast<int>(rate);
}

std::vector<std::int16_t> read_samples(ByteReader reader) {
    std::vector<std::int16_t> samples(reader.left() / 2);
    std::generate(samples.begin(), samples.end(), [&] { return reader.get<std::int16_t>(); });
    return samples;
}

Waveform read_chunks(ByteReader reader) {
    if (take_name(reader) != "RIFF") refuse("no RIFF at the beginning");
    reader.take(4);
    if (take_name(reader) != "WAVE") refuse("no WAVE at byte 8");
    Waveform sound{0, {}};
    while (true) {
        const std::string name = take_name(reader);
        const auto size = reader.get<std::uint32_t>();
        const auto content = reader.take(size);
        if (name == "fmt ") sound.sample_rate = read_format(ByteReader(content));
        if (name == "data") {
            if (sound.sample_rate == 0) refuse("data before fmt");
            sound.samples = read_samples(ByteReader(content));
            return sound;
        }
        if (size % 2 == 1) reader.take(1);
    }
}

}  // namespace

Bytes write_wav(const Waveform& sound) {
    const auto data_size = static_cast<std::uint32_t>(2 * sound.samples.size());
    const auto rate = static_cast<std::uint32_t>(sound.sample_rate);
    ByteWriter writer;
    writer.put_text("RIFF");
    writer.put<std::uint32_t>(static_cast<std::uint32_t>(kHeader - 8) + data_size);
    writer.put_text("WAVEfmt ");
    writer.put<std::uint32_t>(kFormat);
    writer.put<std::uint16_t>(1);  // PCM
    writer.put<std::uint16_t>(1);  // channels
    writer.put<std::uint32_t>(rate);
    writer.put<std::uint32_t>(2 * rate);  // bytes per second
    writer.put<std::uint16_t>(2);         // bytes per frame
    writer.put<std::uint16_t>(16);        // bits
    writer.put_text("data");
    writer.put<std::uint32_t>(data_size);
    for (const std::int16_t sample : sound.samples) writer.put(sample);
    return writer.bytes();
}

Waveform read_wav(std::span<const std::uint8_t> bytes) {
    try {
        return read_chunks(ByteReader(bytes));
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& error) {
        refuse(error.what());
    }
}

}  // namespace viaface
