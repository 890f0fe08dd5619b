#include "synth/learn/sentences.hpp"

#include <sstream>

#include "base/error.hpp"
#include "base/whole_file.hpp"

namespace viaface {

std::vector<std::string> read_sentences(const std::filesystem::path& file) {
    std::vector<std::string> sentences;
    std::istringstream in(read_text(file, "corpus"));
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line.front() != '#') sentences.push_back(line);
    }
    if (sentences.empty()) throw InputError("corpus", file.string(), "a text with a sentence per line");
    return sentences;
}

}  // namespace viaface
