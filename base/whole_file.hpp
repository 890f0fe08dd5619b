// Files that appear whole or not at all: written beside their place, then renamed into it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/bytes.hpp"

namespace viaface {

// A name beside `final_path` to write to; commit() renames it into place, destruction without commit removes
// it. InputError(field, ...) when the folder cannot be written to, or the place is a folder's.
class WholeFile {
  public:
    explicit WholeFile(std::filesystem::path final_path, const std::string& field = "output");
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    const std::filesystem::path& path() const { return partial_; }
    void commit();

  private:
    std::filesystem::path final_, partial_;
    bool committed_ = false;
};

// The same for a folder. InputError("output", ...) when it cannot be made or the place holds anything
// already.
class WholeFolder {
  public:
    explicit WholeFolder(std::filesystem::path final_path);
    ~WholeFolder();
    WholeFolder(const WholeFolder&) = delete;
    WholeFolder& operator=(const WholeFolder&) = delete;

    const std::filesystem::path& path() const { return partial_; }
    void commit();

  private:
    std::filesystem::path final_, partial_;
    bool committed_ = false;
};

void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_whole(const std::filesystem::path& path, std::string_view text);

// InputError(field, path, ...) when missing, unreadable or over `limit` bytes.
Bytes read_bytes(const std::filesystem::path& path, const std::string& field, std::size_t limit = 1u << 30);
std::string read_text(const std::filesystem::path& path, const std::string& field,
                      std::size_t limit = 1u << 30);

}  // namespace viaface
