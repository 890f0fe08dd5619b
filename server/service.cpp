#include "server/service.hpp"

#include <httplib.h>
#undef _res  // <resolv.h> makes this a macro, which Eigen uses as a name

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "server/accept.hpp"
#include "server/admission.hpp"
#include "server/film_stream.hpp"
#include "server/http_body.hpp"
#include "server/openapi.hpp"
#include "server/problem.hpp"
#include "server/requests.hpp"
#include "server/via_answers.hpp"
#include "synth/render/render.hpp"
#include "synth/say/report_json.hpp"
#include "synth/talker/stream_models.hpp"
#include "synth/talker/talker_shelf.hpp"
#include "web/web_files.hpp"

namespace viaface {
namespace {

using nlohmann::json;

constexpr int kSpareThreads = 8;  // for what is answered at once, also when all jobs are taken
constexpr int kRetryAfter = 5;    // s

void answer(httplib::Response& response, const json& body) { response.set_content(body.dump(), kJsonType); }

void answer(httplib::Response& response, const Problem& problem) {
    response.status = problem.status;
    if (problem.status == 503) response.set_header("Retry-After", std::to_string(kRetryAfter));
    response.set_content(problem.body.dump(), kProblemType);
}

// Of what via points are answered as.
std::string_view accepted_type(const httplib::Request& request) {
    constexpr std::array<std::string_view, 2> kOffered = {kJsonType, kViaType};
    std::string accept;
    const auto [first, last] = request.headers.equal_range("Accept");
    for (auto header = first; header != last; ++header)
        accept += (accept.empty() ? "" : ", ") + header->second;
    if (const auto type = preferred_type(accept, kOffered)) return *type;
    throw HttpError(406, "Not Acceptable",
                    "\"" + accept + "\" holds neither " + kJsonType + " nor " + kViaType);
}

// What a job needs until its stream ends.
struct VideoJob {
    VideoRequest request;
    std::optional<MotionInput> moving;  // drawn in place of what would be said
    std::shared_ptr<const Talker> talker;
    std::unique_ptr<Admission::Place> place;
};

}  // namespace

class Service::Routes {
  public:
    explicit Routes(const ServiceOptions& options)
        : shelf_(options.talkers),
          models_(all_stream_models(options.talkers)),
          admission_(options.running, options.waiting) {
        shelf_.load(kDefaultTalker);
        bound_server(options);
        add_gets();
        add_posts();
        add_page();
    }

    void listen() {
        listening_ = true;
        if (!stopping_) server.listen_after_bind();
        listening_ = false;
    }
    // The library forgets a stop that comes before it listens.
    void stop() {
        stopping_ = true;
        while (listening_ && !server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        server.stop();
    }

    httplib::Server server;
    int port = 0;
    std::vector<std::string> served;  // "GET /healthz", ...

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
                const Problem told = problem_of(error);
                if (told.status == 500) log_failure(error);
                answer(response, told);
            }
        });
        server.set_error_handler([this](const auto& request, auto& response) { explain(request, response); });
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
    void explain(const httplib::Request& request, httplib::Response& response) const {
        if (!response.body.empty()) return;
        const std::string allowed = methods_of(request.path);
        if (response.status != 404) {
            answer(response, problem(response.status, "Request not served", "the request could not be read"));
        } else if (allowed.empty()) {
            answer(response, problem(404, "Not Found", request.path + " is not served; see /openapi.json"));
        } else {
            response.set_header("Allow", allowed);
            answer(response,
                   problem(405, "Method Not Allowed", request.path + " is served to " + allowed + " alone"));
        }
    }

    std::string methods_of(const std::string& path) const {
        for (const auto& route : served) {
            const std::size_t space = route.find(' ');
            if (route.substr(space + 1) == path) return route.substr(0, space);
        }
        return {};
    }

    void get(const std::string& path, const httplib::Server::Handler& handler) {
        served.push_back("GET " + path);
        server.Get(path, handler);
    }
    void post(const std::string& path, const httplib::Server::HandlerWithContentReader& handler) {
        served.push_back("POST " + path);
        server.Post(path, handler);
    }

    void add_gets() {
        get("/healthz", [this](const auto&, auto& response) {
            answer(
                response,
                json{{"status", "ok"}, {"running", admission_.running()}, {"waiting", admission_.waiting()}});
        });
        get("/openapi.json", [](const auto&, auto& response) { answer(response, openapi()); });
        get("/v1/voices", [](const auto&, auto& response) {
            json voices = json::array();
            for (const auto& name : FliteVoice::names())
                voices.push_back({{"name", name}, {"language", "en"}});
            answer(response, json{{"voices", voices}, {"default", kDefaultVoice}});
        });
        get("/v1/talkers", [this](const auto&, auto& response) {
            answer(response, json{{"talkers", descriptions()}, {"default", kDefaultTalker}});
        });
    }

    json descriptions() const {
        json talkers = json::array();
        try {
            for (const auto& name : shelf_.names()) talkers.push_back(shelf_.description(name));
        } catch (const InputError&) {  // in a file of ours: nothing that the client could mend
            std::throw_with_nested(std::runtime_error("listing the talkers"));
        }
        return talkers;
    }

    void settle_speaker(VideoJob& job) {
        job.talker = shelf_.load(job.request.talker);
        settle_voice(job.request, *job.talker);
        const Script checked(job.request.say.speech);
    }

    void add_posts() {
        post("/v1/videos", [this](const auto& request, auto& response, const auto& reader) {
            auto job = std::make_shared<VideoJob>();
            if (body_type(request) == kViaType) {
                const Bytes stream = via_body(request, reader);
                job->request = drawing_request_of(request.params, talker_of(stream));
                job->talker = shelf_.load(job->request.talker);
                job->moving = streamed_motion(stream, *job->talker, models_);
            } else {
                job->request = video_request_of(json_body(request, reader));
                settle_speaker(*job);
            }
            job->place = admission_.reserve();
            response.status = 200;
            response.set_chunked_content_provider(
                stream_type(job->request.format),
                [this, job](std::size_t, httplib::DataSink& client) { return stream(*job, client); });
        });
        post("/v1/viapoints", [this](const auto& request, auto& response, const auto& reader) {
            const bool as_stream = accepted_type(request) == kViaType;
            auto job = std::make_shared<VideoJob>();
            job->request = viapoints_request_of(json_body(request, reader));
            settle_speaker(*job);
            job->place = admission_.reserve();
            response.status = 200;
            response.set_chunked_content_provider(
                as_stream ? kViaType : kJsonType,
                [this, job, as_stream](std::size_t, httplib::DataSink& client) {
                    return send_points(*job, as_stream, client);
                });
        });
    }

    // False cuts the connection.
    bool send_points(const VideoJob& job, bool as_stream, httplib::DataSink& client) {
        if (!job.place->wait_for_turn([&] { return !stopping_ && client.is_writable(); })) return false;
        return send_whole(client, stopping_, [&](const std::function<void()>& check_wanted) {
            const Script script(job.request.say.speech);
            if (!as_stream)
                return viapoints_json(script, job.request.say.speech, *job.talker, check_wanted).dump();
            const auto model = std::ranges::find(models_, job.talker->name(), &StreamModel::name);
            const Bytes stream =
                spoken_stream(script, *job.talker, model == models_.end() ? nullptr : &*model, check_wanted);
            return std::string(stream.begin(), stream.end());
        });
    }

    // False cuts the connection.
    bool stream(const VideoJob& job, httplib::DataSink& client) {
        if (!job.place->wait_for_turn([&] { return !stopping_ && client.is_writable(); })) return false;
        return stream_film(film_of(job.request), client, stopping_,
                           [&](FilmWriter& film) { perform(job, film); });
    }

    static void perform(const VideoJob& job, FilmWriter& film) {
        if (!job.moving) {
            say(job.request.say, *job.talker, film);
            return;
        }
        RenderRequest request{
            .view = job.request.say.view, .fps = job.request.say.fps, .seed = job.request.say.seed};
        request.from_s = job.moving->motion.time_s.front();
        render(request, *job.moving, Sound{}, *job.talker, film);
    }

    void add_page() {
        for (const WebFile& file : web_files()) {
            const auto serve = [&file](const auto&, auto& response) {
                response.set_content(file.content.data(), file.content.size(), content_type_of(file.name));
            };
            get("/" + std::string(file.name), serve);
            if (file.name == "index.html") get("/", serve);
        }
    }

    std::atomic<bool> listening_ = false, stopping_ = false;
    TalkerShelf shelf_;
    std::vector<StreamModel> models_;  // of all talkers
    Admission admission_;
};

std::string content_type_of(std::string_view page_file) {
    if (page_file.ends_with(".css")) return "text/css; charset=utf-8";
    if (page_file.ends_with(".js")) return "text/javascript; charset=utf-8";
    return "text/html; charset=utf-8";
}

const char* stream_type(FilmFormat format) {
    return format == FilmFormat::kMkv ? "video/matroska" : "video/mp4";
}

Service::Service(const ServiceOptions& options) : routes_(std::make_unique<Routes>(options)) {}
Service::~Service() = default;

int Service::port() const { return routes_->port; }
void Service::listen() { routes_->listen(); }
void Service::stop() { routes_->stop(); }
std::vector<std::string> Service::routes() const { return routes_->served; }

}  // namespace viaface
