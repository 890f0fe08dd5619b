#include "tests/server/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "base/whole_file.hpp"

namespace viaface {
namespace {

namespace fs = std::filesystem;

fs::path own_name(const fs::path& folder, const char* what) {
    static std::atomic<int> count{0};
    return folder / (std::string(".") + what + std::to_string(count++));
}

void redirect(int descriptor, const fs::path& file, int flags) {
    const int opened = open(file.c_str(), flags, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

std::string taken(const fs::path& file) {
    std::string content = read_text(file, "output of the program");
    fs::remove(file);
    return content;
}

}  // namespace

ProgramRun::ProgramRun(const fs::path& folder, const std::vector<std::string>& arguments,
                       const std::string& input)
    : in_(own_name(folder, "in")), out_(own_name(folder, "out")), err_(own_name(folder, "err")) {
    std::ofstream(in_, std::ios::binary) << input;
    std::vector<char*> argv{const_cast<char*>(VIAFACE_PROGRAM)};
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("fork failed");
    if (process_ > 0) return;
    if (chdir(folder.c_str()) != 0) _exit(126);
    redirect(STDIN_FILENO, in_, O_RDONLY);
    redirect(STDOUT_FILENO, out_, O_WRONLY | O_CREAT | O_TRUNC);
    redirect(STDERR_FILENO, err_, O_WRONLY | O_CREAT | O_TRUNC);
    execv(VIAFACE_PROGRAM, argv.data());
    _exit(127);
}

ProgramRun::~ProgramRun() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

Outcome ProgramRun::outcome() {
    int status = 0;
    for (int tick = 0; waitpid(process_, &status, WNOHANG) == 0; ++tick) {
        if (tick > 100 * kLongestRun) throw std::runtime_error("the program did not end in time");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    process_ = -1;
    fs::remove(in_);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), taken(out_), taken(err_)};
}

}  // namespace viaface
