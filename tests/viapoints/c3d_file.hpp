// C3D files made by hand, byte by byte from the format's description, apart from our own writer.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/bytes.hpp"

namespace viaface {

struct HandC3d {
    int processor = 84;       // 84 Intel, 85 DEC, 86 MIPS
    bool floats = false;      // points and analog
    int parameter_block = 2;  // 1-based
    int spare_blocks = 0;     // between parameters and data
    int points = 2, frames = 3, analog_channels = 0, analog_per_frame = 0;
    double scale = 0.5, rate = 100;  // scale without sign
    std::string units = "mm";
    std::vector<std::string> labels = {"A", "B"};
    bool groups_last = false;                   // records of groups behind those of their parameters
    std::vector<double> frames_parameter = {};  // instead of `frames`, as one float
    int frames_word = -1;                       // instead of `frames`
    std::vector<int> trial = {};                // ACTUAL_START_FIELD and ACTUAL_END_FIELD, two words each
    int header_points = -1, header_data_start = -1;

    // x y z and the residual's raw word of a point; the word < 0: missing.
    struct Raw {
        double x, y, z;
        int word;
    };
    std::function<Raw(int frame, int point)> at = [](int frame, int point) {
        return Raw{frame + 1.0, -(point + 1.0), 0.5, 0x0104};
    };

    Bytes bytes() const {
        Bytes section = parameters(0);
        const int blocks = static_cast<int>(section.size() / 512);
        const int data_block = parameter_block + blocks + spare_blocks;
        section = parameters(data_block);
        Bytes file = header(header_data_start < 0 ? data_block : header_data_start);
        file.resize(static_cast<std::size_t>(parameter_block - 1) * 512, 0xee);
        file.insert(file.end(), section.begin(), section.end());
        file.resize(static_cast<std::size_t>(data_block - 1) * 512);
        for (int f = 0; f < frames; ++f) frame(file, f);
        return file;
    }

    double stored_scale() const { return floats ? -scale : scale; }

  private:
    void word(Bytes& to, int value) const {
        const auto low = static_cast<std::uint8_t>(value), high = static_cast<std::uint8_t>(value >> 8);
        to.push_back(processor == 86 ? high : low);
        to.push_back(processor == 86 ? low : high);
    }

    void real(Bytes& to, double value) const {
        const auto single = static_cast<float>(value);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &single, 4);
        const auto b = [&](int shift) { return static_cast<std::uint8_t>(bits >> shift); };
        if (processor == 84) to.insert(to.end(), {b(0), b(8), b(16), b(24)});
        if (processor == 86) to.insert(to.end(), {b(24), b(16), b(8), b(0)});
        if (processor != 85) return;
        if (single == 0)
            bits = 0;
        else
            bits += 2u << 23;  // VAX F: the exponent is 2 above IEEE's for the same value
        to.insert(to.end(), {b(16), b(24), b(0), b(8)});
    }

    Bytes header(int data_block) const {
        Bytes h = {static_cast<std::uint8_t>(parameter_block), 0x50};
        for (const int w : {header_points < 0 ? points : header_points, analog_channels * analog_per_frame, 1,
                            std::min(frames, 65535), 0})
            word(h, w);
        real(h, stored_scale());
        word(h, data_block);
        word(h, analog_per_frame);
        real(h, rate);
        h.resize(512);
        return h;
    }

    void record(Bytes& to, int group, const std::string& name, const Bytes& rest, bool last = false) const {
        to.push_back(static_cast<std::uint8_t>(name.size()));
        to.push_back(static_cast<std::uint8_t>(group));
        to.insert(to.end(), name.begin(), name.end());
        word(to, last ? 0 : static_cast<int>(rest.size()) + 2);
        to.insert(to.end(), rest.begin(), rest.end());
    }
    void group(Bytes& to, int number, const std::string& name) const {
        record(to, -number, name, {3, 'a', 'b', 'c'});  // a description of three characters
    }
    void words(Bytes& to, int group, const std::string& name, const std::vector<int>& values) const {
        Bytes rest = {2, 0};
        if (values.size() != 1) rest = {2, 1, static_cast<std::uint8_t>(values.size())};
        for (const int value : values) word(rest, value);
        rest.push_back(0);
        record(to, group, name, rest);
    }
    void reals(Bytes& to, int group, const std::string& name, double value) const {
        Bytes rest = {4, 0};
        real(rest, value);
        rest.push_back(0);
        record(to, group, name, rest);
    }
    void texts(Bytes& to, int group, const std::string& name, const std::vector<std::string>& values,
               bool last = false) const {
        constexpr std::size_t kWidth = 8;
        Bytes rest = {0xff, 2, kWidth, static_cast<std::uint8_t>(values.size())};
        for (std::string value : values) {
            value.resize(kWidth, ' ');
            rest.insert(rest.end(), value.begin(), value.end());
        }
        rest.push_back(0);
        record(to, group, name, rest, last);
    }

    Bytes parameters(int data_block) const {
        Bytes s = {0, 0, 0, static_cast<std::uint8_t>(processor)};
        if (!groups_last) group(s, 7, "POINT");
        words(s, 7, "USED", {points});
        reals(s, 7, "SCALE", stored_scale());
        reals(s, 7, "RATE", rate);
        words(s, 7, "DATA_START", {data_block});
        if (!frames_parameter.empty()) {
            reals(s, 7, "FRAMES", frames_parameter[0]);
        } else {
            words(s, 7, "FRAMES", {frames_word < 0 ? frames : frames_word});
        }
        if (!trial.empty()) {
            group(s, 9, "TRIAL");
            words(s, 9, "ACTUAL_START_FIELD", {trial[0], trial[1]});
            words(s, 9, "ACTUAL_END_FIELD", {trial[2], trial[3]});
        }
        for (std::size_t first = 0, part = 1; first < labels.size(); first += 255, ++part) {
            const auto end =
                labels.begin() + static_cast<std::ptrdiff_t>(std::min(labels.size(), first + 255));
            texts(s, 7, "labels" + (part == 1 ? "" : std::to_string(part)),
                  {labels.begin() + static_cast<std::ptrdiff_t>(first), end});
        }
        if (groups_last) group(s, 7, "POINT");
        texts(s, 7, "UNITS", {units}, true);
        s.resize((s.size() + 511) / 512 * 512);
        s[2] = static_cast<std::uint8_t>(s.size() / 512);
        return s;
    }

    void frame(Bytes& to, int f) const {
        for (int p = 0; p < points; ++p) {
            const Raw raw = at(f, p);
            if (floats) {
                for (const double value : {raw.x, raw.y, raw.z, static_cast<double>(raw.word)})
                    real(to, value);
            } else {
                for (const double value : {raw.x, raw.y, raw.z})
                    word(to, static_cast<int>(std::lround(value / scale)));
                word(to, raw.word);
            }
        }
        for (int k = 0; k < analog_channels * analog_per_frame; ++k) {
            if (floats) {
                real(to, 1e9);
            } else {
                word(to, 0x7777);
            }
        }
    }
};

}  // namespace viaface
