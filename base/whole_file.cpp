#include "base/whole_file.hpp"

#include <unistd.h>

#include <atomic>
#include <fstream>

#include "base/error.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

fs::path beside(const fs::path& final_path) {
    static std::atomic<unsigned> count{0};
    const std::string tag = ".part" + std::to_string(getpid()) + "." + std::to_string(count++);
    return final_path.parent_path() / ("." + final_path.filename().string() + tag);
}

template <class Container>
Container read_all(const fs::path& path, const std::string& field, std::size_t limit) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in || fs::is_directory(path)) throw InputError(field, path.string(), "a readable file");
    const auto size = static_cast<std::size_t>(in.tellg());
    if (size > limit) {
        throw InputError(field, path.string(), "a file of at most " + std::to_string(limit) + " bytes");
    }
    Container content(size, 0);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(size));
    if (!in) throw std::runtime_error("reading " + path.string() + " failed");
    return content;
}

}  // namespace

WholeFile::WholeFile(fs::path final_path, const std::string& field)
    : final_(std::move(final_path)), partial_(beside(final_)) {
    if (fs::is_directory(final_) || !std::ofstream(partial_, std::ios::binary)) {
        throw InputError(field, final_.string(), "a file in an existing folder that can be written to");
    }
}

WholeFile::~WholeFile() {
    std::error_code ignored;
    if (!committed_) fs::remove_all(partial_, ignored);
}

void WholeFile::commit() {
    fs::rename(partial_, final_);
    committed_ = true;
}

WholeFolder::WholeFolder(fs::path final_path)
    : final_(final_path.has_filename() ? final_path : final_path.parent_path()), partial_(beside(final_)) {
    std::error_code failed;
    const bool free = !fs::exists(final_) || (fs::is_directory(final_) && fs::is_empty(final_, failed));
    if (!free || failed || !fs::create_directory(partial_, failed)) {
        throw InputError("output", final_.string(), "a new or empty folder in one that can be written to");
    }
}

WholeFolder::~WholeFolder() {
    std::error_code ignored;
    if (!committed_) fs::remove_all(partial_, ignored);
}

void WholeFolder::commit() {
    fs::rename(partial_, final_);
    committed_ = true;
}

void write_whole(const fs::path& path, std::span<const std::uint8_t> bytes) {
    WholeFile file(path);
    std::ofstream out(file.path(), std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error("writing " + path.string() + " failed");
    file.commit();
}

void write_whole(const fs::path& path, std::string_view text) {
    write_whole(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Bytes read_bytes(const fs::path& path, const std::string& field, std::size_t limit) {
    return read_all<Bytes>(path, field, limit);
}

std::string read_text(const fs::path& path, const std::string& field, std::size_t limit) {
    return read_all<std::string>(path, field, limit);
}

}  // namespace viaface
