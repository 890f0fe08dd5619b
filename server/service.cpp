#include "server/service.hpp"

#include <httplib.h>
#undef _res  // <resolv.h> makes this a macro, which Eigen uses as a name

#include <cstdio>

#include "server/admission.hpp"
#include "server/openapi.hpp"
#include "server/problem.hpp"
#include "server/requests.hpp"
#include "synth/say/report_json.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "web/web_files.hpp"

namespace viaface {
namespace {

using nlohmann::json;

constexpr int kSpareThreads = 8;  // for what is answered at once, also when all jobs are taken
constexpr int kRetryAfter = 5;    // s

constexpr const char* kJsonType = "application/json";

std::string content_type_of(std::string_view name) {
    if (name.ends_with(".css")) return "text/css; charset=utf-8";
    if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
    return "text/html; charset=utf-8";
}

void answer(httplib::Response& response, const json& body) { response.set_content(body.dump(), kJsonType); }

void answer(httplib::Response& response, const Problem& problem) {
    response.status = problem.status;
    if (problem.status == 503) response.set_header("Retry-After", std::to_string(kRetryAfter));
    response.set_content(problem.body.dump(), kProblemType);
}

class NotJson : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};
class WrongType : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

json body_of(const httplib::Request& request) {
    const std::string type = request.get_header_value("Content-Type");
    if (type.substr(0, type.find(';')) != kJsonType)
        throw WrongType("\"" + type + "\" is not application/json");
    try {
        return json::parse(request.body);
    } catch (const json::exception& error) {
        throw NotJson(error.what());
    }
}

Problem http_problem_of(const std::exception& error) {
    if (dynamic_cast<const NotJson*>(&error) != nullptr) return problem(400, "Bad Request", error.what());
    if (dynamic_cast<const WrongType*>(&error) != nullptr)
        return problem(415, "Unsupported Media Type", error.what());
    return problem_of(error);
}

void log_failure(const std::exception& error) {
    std::fprintf(stderr, "viaface: %s\n", describe(error).c_str());
}

// What a job needs until its stream ends.
struct VideoJob {
    VideoRequest request;
    std::shared_ptr<const Talker> talker;
    std::unique_ptr<Admission::Place> place;
};

// The film, piece by piece, to a client; false cuts the connection without the closing chunk.
bool stream(const VideoJob& job, httplib::DataSink& sink) {
    try {
        if (!job.place->wait_for_turn([&] { return sink.is_writable(); })) return false;
        const View& view = job.request.say.view;
        const auto film = open_film(
            FilmSpec{view.width, view.height, job.request.say.fps}, [&](std::span<const std::uint8_t> piece) {
                return sink.write(reinterpret_cast<const char*>(piece.data()), piece.size());
            });
        say(job.request.say, *job.talker, *film);
        sink.done();
        return true;
    } catch (const ClientLeft&) {
        return false;
    } catch (const std::exception& error) {
        log_failure(error);
        return false;
    }
}

}  // namespace

class Service::Routes {
  public:
    explicit Routes(const ServiceOptions& options)
        : shelf_(options.talkers), admission_(options.running, options.waiting) {
        shelf_.load(kDefaultTalker);
        bound_server(options);
        add_gets();
        add_posts();
        add_page();
    }

    httplib::Server server;
    int port = 0;

  private:
    void bound_server(const ServiceOptions& options) {
        const auto threads = static_cast<std::size_t>(options.running + options.waiting + kSpareThreads);
        server.new_task_queue = [threads] { return new httplib::ThreadPool(threads); };
        server.set_payload_max_length(kLargestBody);
        server.set_keep_alive_max_count(100);
        server.set_exception_handler([](const auto&, auto& response, std::exception_ptr thrown) {
            try {
                std::rethrow_exception(thrown);
            } catch (const std::exception& error) {
                const Problem told = http_problem_of(error);
                if (told.status == 500) log_failure(error);
                answer(response, told);
            }
        });
        server.set_error_handler([](const auto& request, auto& response) { explain(request, response); });
        port = options.port;
        if (port == 0) {
            port = server.bind_to_any_port(options.host);
        } else if (!server.bind_to_port(options.host, port)) {
            port = -1;
        }
        if (port < 0) {
            throw InputError("port", options.host + ":" + std::to_string(options.port),
                             "an address of this machine and a port that is free");
        }
    }

    // Statuses that the library sets by itself.
    static void explain(const httplib::Request& request, httplib::Response& response) {
        if (!response.body.empty()) return;
        const int status = response.status;
        if (status == 404) {
            answer(response,
                   problem(404, "Not Found",
                           request.method + " " + request.path + " is not served; see /openapi.json"));
        } else if (status == 413) {
            answer(response, problem(413, "Content Too Large",
                                     "a body holds at most " + std::to_string(kLargestBody) + " bytes"));
        } else {
            answer(response, problem(status, "Request not served", "the request could not be read"));
        }
    }

    void add_gets() {
        server.Get("/healthz", [this](const auto&, auto& response) {
            answer(
                response,
                json{{"status", "ok"}, {"running", admission_.running()}, {"waiting", admission_.waiting()}});
        });
        server.Get("/openapi.json", [](const auto&, auto& response) { answer(response, openapi()); });
        server.Get("/v1/voices", [](const auto&, auto& response) {
            json voices = json::array();
            for (const auto& name : FliteVoice::names())
                voices.push_back({{"name", name}, {"language", "en"}});
            answer(response, json{{"voices", voices}, {"default", kDefaultVoice}});
        });
        server.Get("/v1/talkers", [this](const auto&, auto& response) {
            json talkers = json::array();
            for (const auto& name : shelf_.names()) talkers.push_back(shelf_.description(name));
            answer(response, json{{"talkers", talkers}, {"default", kDefaultTalker}});
        });
    }

    void add_posts() {
        server.Post("/v1/videos", [this](const auto& request, auto& response) {
            auto job = std::make_shared<VideoJob>();
            job->request = video_request_of(body_of(request));
            const Script checked(job->request.say.speech);
            job->talker = shelf_.load(job->request.talker);
            job->place = admission_.reserve();
            response.set_chunked_content_provider(
                kStreamType, [job](std::size_t, httplib::DataSink& sink) { return stream(*job, sink); });
        });
        server.Post("/v1/viapoints", [this](const auto& request, auto& response) {
            const VideoRequest asked = viapoints_request_of(body_of(request));
            const Script script(asked.say.speech);
            const auto talker = shelf_.load(asked.talker);
            const auto place = admission_.reserve();
            place->wait_for_turn([] { return true; });
            answer(response, viapoints_json(script, asked.say.speech, *talker));
        });
    }

    void add_page() {
        for (const WebFile& file : web_files()) {
            const auto serve = [&file](const auto&, auto& response) {
                response.set_content(file.content.data(), file.content.size(), content_type_of(file.name));
            };
            server.Get("/" + std::string(file.name), serve);
            if (file.name == "index.html") server.Get("/", serve);
        }
    }

    TalkerShelf shelf_;
    Admission admission_;
};

Service::Service(const ServiceOptions& options) : routes_(std::make_unique<Routes>(options)) {}
Service::~Service() = default;

int Service::port() const { return routes_->port; }
void Service::listen() { routes_->server.listen_after_bind(); }
void Service::stop() { routes_->server.stop(); }

}  // namespace viaface
