#include "server/film_output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "server/commands.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "viapoints/motion_csv.hpp"

namespace viaface {
namespace {

bool write_to_stdout(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

std::unique_ptr<FilmWriter> open_output(FilmSpec spec, const std::string& output) {
    if (output == "-") return open_film(spec, write_to_stdout);
    spec.format = film_format_of(output);
    return open_film(spec, std::filesystem::path(output));
}

std::filesystem::path talker_folder(const std::string& name) {
    const bool folder = name.find('/') != std::string::npos;
    return folder ? std::filesystem::path(name) : TalkerShelf(talkers_folder()).path_of(name);
}

std::shared_ptr<const Talker> talker_at(const std::string& name) {
    return std::make_shared<const Talker>(load_talker(talker_folder(name)));
}

void MotionRows::add(double time_s, const Configuration& points) {
    time_s_.push_back(time_s);
    for (const double mm : points) mm_.push_back(std::round(mm * 1e4) / 1e4);
}

std::string MotionRows::text(const std::string& what) const {
    const auto rows = static_cast<Eigen::Index>(time_s_.size());
    const Motion motion{time_s_, Eigen::Map<const RowMatrix>(mm_.data(), rows, kCoordinates)};
    return format_motion_csv(motion, {what, "mm, head frame: x to the talker's left, y up, z forward"});
}

SideFile::SideFile(const std::string& option, const std::string& path) {
    if (!path.empty()) file_.emplace(path, option);
}

void SideFile::write(std::string_view text) {
    std::ofstream out(file_->path(), std::ios::binary | std::ios::trunc);
    if (!out.write(text.data(), static_cast<std::streamsize>(text.size())).flush())
        throw std::runtime_error("writing " + file_->path().string() + " failed");
}

void SideFile::commit() {
    if (file_) file_->commit();
}

}  // namespace viaface
