// What the commands that make films write: the film, and files beside it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/whole_file.hpp"
#include "synth/film/film_writer.hpp"
#include "synth/talker/talker.hpp"

namespace viaface {

// x.mp4, x.mkv, a folder, or - for stdout; the format follows. InputError("output") or as validate().
std::unique_ptr<FilmWriter> open_output(FilmSpec spec, const std::string& output);

// A built-in talker by name, or a talker's folder (with a / in it).
std::filesystem::path talker_folder(const std::string& name);
std::shared_ptr<const Talker> talker_at(const std::string& name);

// Frames as rows of a motion file, to a ten-thousandth of a mm.
class MotionRows {
  public:
    void add(double time_s, const Configuration& points);
    std::string text(const std::string& what) const;

  private:
    std::vector<double> time_s_, mm_;
};

// A file beside the film: its place is taken before any work is done. None for an empty path.
class SideFile {
  public:
    SideFile(const std::string& option, const std::string& path);
    bool wanted() const { return file_.has_value(); }
    void write(std::string_view text);
    void commit();

  private:
    std::optional<WholeFile> file_;
};

}  // namespace viaface
