#include <csignal>
#include <cstdio>
#include <thread>

#include "server/commands.hpp"
#include "server/service.hpp"

namespace viaface {
namespace {

// Stops the service at SIGINT or SIGTERM, which this thread alone receives.
class Stopper {
  public:
    Stopper() {
        sigemptyset(&signals_);
        sigaddset(&signals_, SIGINT);
        sigaddset(&signals_, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    }
    void watch(Service& service) {
        std::thread([this, &service] {
            int received = 0;
            sigwait(&signals_, &received);
            service.stop();
        }).detach();
    }

  private:
    sigset_t signals_;
};

int run_serve(const ServiceOptions& options) {
    Stopper stopper;
    std::signal(SIGPIPE, SIG_IGN);
    Service service(options);
    stopper.watch(service);
    std::printf("viaface: serving http://%s:%d/\n", options.host.c_str(), service.port());
    std::fflush(stdout);
    service.listen();
    return 0;
}

}  // namespace

Command add_serve(CLI::App& program) {
    auto options = std::make_shared<ServiceOptions>();
    CLI::App* app = program.add_subcommand("serve", "The HTTP service and its page; see /openapi.json.");
    app->add_option("--host", options->host, "address to listen on")->capture_default_str();
    app->add_option("--port", options->port, "port, 0 for any free one")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    app->add_option("--jobs", options->running, "jobs that run at a time")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app->add_option("--queue", options->waiting, "jobs that may wait; one more is answered 503")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    return [options] {
        options->talkers = talkers_folder();
        return run_serve(*options);
    };
}

}  // namespace viaface
