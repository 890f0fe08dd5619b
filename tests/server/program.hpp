// Runs the built program as a user does, in a folder of its own, bounded in time.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace viaface {

struct Outcome {
    int status = -1;       // exit status; 128 + the signal that ended it
    std::string out, err;  // stdout and stderr
};

// One run; ended by force when it does not end within kLongestRun, and by destruction.
class ProgramRun {
  public:
    static constexpr int kLongestRun = 240;  // s

    // In `folder`, which also holds what it prints, in files hidden by a leading dot.
    ProgramRun(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
               const std::string& input = "");
    ~ProgramRun();
    ProgramRun(const ProgramRun&) = delete;
    ProgramRun& operator=(const ProgramRun&) = delete;

    Outcome outcome();

  private:
    std::filesystem::path in_, out_, err_;
    pid_t process_ = -1;
};

}  // namespace viaface
