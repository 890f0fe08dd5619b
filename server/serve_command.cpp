#include <malloc.h>

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
    mallopt(M_ARENA_MAX, 1);  // an arena a thread would keep the memory of a film each
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
    const auto add_count = [app](const char* option, int& value, const char* description, int most,
                                 int least) {
        const std::string limits = std::to_string(least) + " to " + std::to_string(most);
        app->add_option(option, value, description + (", " + limits))
            ->check(CLI::Range(least, most).description(""))
            ->capture_default_str();
    };
    add_count("--port", options->port, "port to listen on, 0 for any free one", 65535, 0);
    add_count("--jobs", options->running, "films made at a time", 64, 1);
    add_count("--queue", options->waiting, "requests that may wait; one more is answered 503", 1024, 0);
    return [options] {
        options->talkers = talkers_folder();
        return run_serve(*options);
    };
}

}  // namespace viaface
