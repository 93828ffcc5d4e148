// SPDX-License-Identifier: Apache-2.0
#include "cli/watch/live_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <chrono>
#include <thread>
#include <utility>

#include "base/files/errors.h"

namespace throng::cli {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostVisitors = 16;             // at once; each takes a thread
constexpr std::chrono::milliseconds kPatience{2000};  // then it is looked whether anybody is there still

/// As the library has it, but that nobody shares a port with another.
void setSocketOptions(int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

/// A page from elsewhere whose name leads here (DNS rebinding) asks for that name.
bool asksForUs(const httplib::Request& request, int port) {
    const std::string host = request.get_header_value("Host");
    return host == fmt::format("{}:{}", kLoopback, port) || host == fmt::format("localhost:{}", port);
}

/// Tells a visitor what is new, until it goes or there is nothing more.
bool sendNews(const LiveLog& log, LiveLog::Place& place, httplib::DataSink& sink) {
    const LiveLog::News news = log.read(place, kPatience);
    if (news.messages.empty() && !news.closed) {
        static constexpr std::array<char, 8> kNothing = {'N', 'O', 'N', 'E', 0, 0, 0, 0};
        return sink.write(kNothing.data(), kNothing.size());
    }
    std::string bytes;
    for (const LiveLog::Message& message : news.messages)
        bytes += *message;
    if (!bytes.empty() && !sink.write(bytes.data(), bytes.size())) return false;
    if (news.closed) sink.done();
    return true;
}

}  // namespace

struct LiveServer::State {
    httplib::Server server;
    std::string page;
    int port = 0;
    std::thread thread;
};

LiveServer::LiveServer(const LiveLog& log, std::string page, int port) : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.page = std::move(page);
    httplib::Server& server = state.server;
    server.new_task_queue = [] { return new httplib::ThreadPool(kMostVisitors); };  // the library deletes it
    server.set_socket_options(setSocketOptions);
    server.set_tcp_nodelay(true);
    server.set_payload_max_length(1024);
    server.set_keep_alive_timeout(1);
    server.set_pre_routing_handler([&state](const httplib::Request& request, httplib::Response& response) {
        response.set_header("X-Content-Type-Options", "nosniff");
        response.set_header("X-Frame-Options", "DENY");
        response.set_header("Cross-Origin-Resource-Policy", "same-origin");
        response.set_header("Cache-Control", "no-store");
        const bool is_for_us = asksForUs(request, state.port), reads = request.method == "GET";
        if (is_for_us && reads) return httplib::Server::HandlerResponse::Unhandled;
        response.status = is_for_us ? 405 : 403;
        return httplib::Server::HandlerResponse::Handled;
    });
    server.Get("/", [&state](const httplib::Request&, httplib::Response& response) {
        response.set_content(state.page, "text/html; charset=utf-8");
    });
    server.Get("/crowd", [&log](const httplib::Request&, httplib::Response& response) {
        const auto place = std::make_shared<LiveLog::Place>();
        response.set_chunked_content_provider(
            "application/octet-stream",
            [&log, place](std::size_t, httplib::DataSink& sink) { return sendNews(log, *place, sink); });
    });
    state.port =
        port > 0 ? (server.bind_to_port(kLoopback, port) ? port : -1) : server.bind_to_any_port(kLoopback);
    if (state.port <= 0)
        throw OutputError(fmt::format("port {}", port),
                          "cannot be listened on: it is taken, or not yours to take; --port names another");
    state.thread = std::thread([&server] { server.listen_after_bind(); });
    // One that does not run yet cannot be stopped.
    while (!server.is_running())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

LiveServer::~LiveServer() {
    state_->server.stop();
    state_->thread.join();
}

int LiveServer::port() const {
    return state_->port;
}

std::string LiveServer::address() const {
    return fmt::format("http://{}:{}/", kLoopback, state_->port);
}

}  // namespace throng::cli
