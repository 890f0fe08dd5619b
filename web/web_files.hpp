// The page's files, built into the program.
#pragma once

#include <string_view>
#include <vector>

namespace viaface {

struct WebFile {
    std::string_view name;  // "index.html"
    std::string_view content;
};

const std::vector<WebFile>& web_files();

}  // namespace viaface
