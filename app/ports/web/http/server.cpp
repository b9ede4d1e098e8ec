// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/server.h"

#include <microhttpd.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "app/ports/web/http/address.h"
#include "app/ports/web/http/forwarding.h"
#include "app/ports/web/http/reply.h"
#include "hal/socket_address.h"

namespace orbwatch::app::web {
namespace {

constexpr unsigned kThreads = 2;
/// Memory of a connection for request line, headers and query.
constexpr std::size_t kHeadBytes = 32 * 1024;
/// Limit of unsent data in the kernel per client, because queued pictures only age. Another picture
/// is started when less is queued (measured by tests/bench/page with a third of the bandwidth that
/// pictures of 28 kB need: displayed 0.16 s after their exposure; with 128 KiB 0.5 s).
constexpr int kUnsentBytes = 2048;

/// Priorities of GnuTLS: TLS 1.2 and 1.3 with forward secrecy, 128 bits or more, and authenticated
/// ciphers (GCM, ChaCha20-Poly1305); no suite with CBC.
constexpr const char* kTlsPriorities =
    "SECURE128:-VERS-ALL:+VERS-TLS1.3:+VERS-TLS1.2:-RSA:-MAC-ALL:+AEAD";

/// libmicrohttpd's reason for refusing to start; per thread. Later messages concern clients, which
/// could flood the log with them.
thread_local std::string complaint;

void keep_complaint(void* /*server*/, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  complaint = text.data();
  std::erase(complaint, '\n');
}

MHD_Result add_value(void* values, MHD_ValueKind /*kind*/, const char* name, std::size_t name_size,
                     const char* value, std::size_t value_size) {
  static_cast<Values*>(values)->emplace_back(
      std::string(name, name_size), value ? std::string(value, value_size) : std::string());
  return MHD_YES;
}

Values values_of(MHD_Connection* connection, MHD_ValueKind kind) {
  Values values;
  ::MHD_get_connection_values_n(connection, kind, add_value, &values);
  return values;
}

Connections::Connection* connection_of(MHD_Connection* connection) {
  const MHD_ConnectionInfo* info =
      ::MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
  return static_cast<Connections::Connection*>(info->socket_context);
}

/// A request whose body may be incomplete.
struct Arriving {
  std::string target;
  ExchangePtr exchange;             ///< null: its head is incomplete
  std::optional<Response> refusal;  ///< refusal of a malformed request
  bool is_too_large = false;
  bool was_handled = false;
};

void set_option(int socket, int level, int option, int value) {
  // An option that the kernel does not support only costs speed.
  static_cast<void>(::setsockopt(socket, level, option, &value, sizeof value));
}

}  // namespace

/// Callbacks of libmicrohttpd, on its threads; `self` is the server.
struct Server::Callbacks {
  static void connection(void* self, MHD_Connection* connection, void** context,
                         MHD_ConnectionNotificationCode code);
  static void* target(void* self, const char* target, MHD_Connection* connection);
  static void completed(void* self, MHD_Connection* connection, void** state,
                        MHD_RequestTerminationCode code);
  static MHD_Result request(void* self, MHD_Connection* connection, const char* url,
                            const char* method, const char* version, const char* upload,
                            std::size_t* upload_size, void** state);

  static void begin(const Server& server, MHD_Connection* connection, const char* url,
                    const char* method, const char* version, Arriving& arriving);
  static std::optional<Response> refusal(Server& server, Connections::Connection& connection,
                                         Arriving& arriving);
  static void handle(Server& server, Connections::Connection& connection, Arriving& arriving);
  static MHD_Result send(Server& server, MHD_Connection* connection, Arriving& arriving);
  static MHD_Result send_stream(Server& server, MHD_Connection* connection,
                                const Response& response);
};

void Server::Callbacks::connection(void* self, MHD_Connection* connection, void** context,
                                   MHD_ConnectionNotificationCode code) {
  auto& server = *static_cast<Server*>(self);
  if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
    server.connections_.remove(static_cast<Connections::Connection*>(*context));
    --server.counts_.connections;
    return;
  }
  const int socket =
      ::MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
  const sockaddr* peer =
      ::MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS)->client_addr;
  set_option(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, kUnsentBytes);
  set_option(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  const std::string host = hal::text_of(hal::SocketAddress(peer).host());
  // A proxy's connections belong to its clients, and count for them with each request.
  const std::size_t most = is_trusted(host, server.own_.trusted_proxies)
                               ? std::numeric_limits<std::size_t>::max()
                               : server.most_of_an_address();
  Connections::Connection* added = server.connections_.add(socket, host, most);
  ++server.counts_.connections;
  if (added->is_beyond) ++server.counts_.turned_away;
  *context = added;
}

void Server::Callbacks::completed(void* self, MHD_Connection* connection, void** state,
                                  MHD_RequestTerminationCode /*code*/) {
  const std::unique_ptr<Arriving> ended(static_cast<Arriving*>(*state));
  *state = nullptr;
  static_cast<Server*>(self)->connections_.end_answer(connection_of(connection));
}

MHD_Result Server::Callbacks::request(void* self, MHD_Connection* connection, const char* url,
                                      const char* method, const char* version, const char* upload,
                                      std::size_t* upload_size, void** state) {
  auto& server = *static_cast<Server*>(self);
  auto& arriving = *static_cast<Arriving*>(*state);
  if (!arriving.exchange) {
    begin(server, connection, url, method, version, arriving);
    // Refused before the body is sent.
    return arriving.is_too_large ? send(server, connection, arriving) : MHD_YES;
  }
  if (*upload_size == 0) return send(server, connection, arriving);
  std::string& body = arriving.exchange->body();
  arriving.is_too_large |= body.size() + *upload_size > server.settings_.max_body_bytes;
  if (!arriving.is_too_large) body.append(upload, *upload_size);
  *upload_size = 0;
  return MHD_YES;
}

void* Server::Callbacks::target(void* /*self*/, const char* target,
                                MHD_Connection* /*connection*/) {
  auto arriving = std::make_unique<Arriving>();
  arriving->target = target;
  return arriving.release();
}

void Server::Callbacks::begin(const Server& server, MHD_Connection* connection, const char* url,
                              const char* method, const char* version, Arriving& arriving) {
  Request request;
  request.method = method;
  request.target = std::move(arriving.target);
  request.path = url;
  request.query = values_of(connection, MHD_GET_ARGUMENT_KIND);
  request.headers = values_of(connection, MHD_HEADER_KIND);
  request.cookies = values_of(connection, MHD_COOKIE_KIND);
  request.peer = connection_of(connection)->peer;
  request.is_secure = server.endpoint_.pem.has_value();
  if (const std::string* length = request.header(MHD_HTTP_HEADER_CONTENT_LENGTH)) {
    std::size_t bytes = 0;
    const auto parsed = std::from_chars(length->data(), length->data() + length->size(), bytes);
    arriving.is_too_large = parsed.ec != std::errc() || bytes > server.settings_.max_body_bytes;
  }
  arriving.refusal = settle_form(request, version, server.own_);
  arriving.exchange = std::make_shared<Exchange>(std::move(request));
}

/// Refusal of a request; nullopt: it is served.
std::optional<Response> Server::Callbacks::refusal(Server& server,
                                                   Connections::Connection& connection,
                                                   Arriving& arriving) {
  if (!server.connections_.begin_answer(&connection, arriving.exchange)) {
    return error_response(503, "the connection is being closed");
  }
  const std::string& client = arriving.exchange->request().peer;
  if (client != connection.peer &&
      !server.connections_.count_for(&connection, client, server.most_of_an_address())) {
    ++server.counts_.turned_away;
    return error_response(429, "the client has max_connections_per_address of [web] already");
  }
  if (!arriving.refusal && arriving.is_too_large) {
    arriving.refusal =
        error_response(413, "the body is larger than " +
                                std::to_string(server.settings_.max_body_bytes) + " bytes");
  }
  if (arriving.refusal) ++server.counts_.refused;
  return std::move(arriving.refusal);
}

void Server::Callbacks::handle(Server& server, Connections::Connection& connection,
                               Arriving& arriving) {
  arriving.was_handled = true;
  ++server.counts_.requests;
  if (auto refused = refusal(server, connection, arriving)) {
    arriving.exchange->answer(std::move(*refused));
  } else {
    server.handler_(arriving.exchange);
  }
}

MHD_Result Server::Callbacks::send(Server& server, MHD_Connection* connection, Arriving& arriving) {
  Connections::Connection& own = *connection_of(connection);
  if (!arriving.was_handled) handle(server, own, arriving);
  const auto response = arriving.exchange->response_or_suspend(connection);
  if (!response) return MHD_YES;
  if (response->stream) return send_stream(server, connection, *response);
  server.connections_.begin_sending(&own, *response);
  const Reply reply = make_reply(*response, server.endpoint_.headers);
  if (!reply) return MHD_NO;
  return ::MHD_queue_response(connection, static_cast<unsigned>(response->status), reply.get());
}

MHD_Result Server::Callbacks::send_stream(Server& server, MHD_Connection* connection,
                                          const Response& response) {
  auto sender = std::make_shared<StreamSender>(response.stream, connection);
  response.stream->on_data([weak = std::weak_ptr(sender)] {
    if (const auto alive = weak.lock()) alive->wake();
  });
  if (!server.connections_.begin_stream(connection_of(connection), sender, response.may_go_on))
    return MHD_NO;
  ++server.counts_.streams;
  const Reply reply = make_reply(response, server.endpoint_.headers, std::move(sender),
                                 [&counts = server.counts_] { --counts.streams; });
  if (!reply) return MHD_NO;
  return ::MHD_queue_response(connection, static_cast<unsigned>(response.status), reply.get());
}

Server::Server(const WebSettings& settings, Endpoint endpoint, Handler handler,
               ServerCounts& counts)
    : settings_(settings),
      endpoint_(std::move(endpoint)),
      handler_(std::move(handler)),
      counts_(counts),
      connections_(settings.request_timeout) {}

Result<std::unique_ptr<Server>> Server::open(const WebSettings& settings, Endpoint endpoint,
                                             Handler handler, ServerCounts& counts) {
  std::unique_ptr<Server> server(
      new Server(settings, std::move(endpoint), std::move(handler), counts));
  if (auto listens = server->listen(); !listens) return tl::unexpected(listens.error());
  return server;
}

std::size_t Server::most_of_an_address() const {
  return static_cast<std::size_t>(settings_.max_connections_per_address);
}

Result<> Server::listen() {
  auto trusted = hal::parse_networks(settings_.trusted_proxies);
  if (!trusted) return fail("web: trusted_proxies: " + trusted.error().message);
  own_ = {settings_.names, std::move(*trusted)};
  const auto address = hal::parse_address(endpoint_.address, endpoint_.port);
  const std::string where = endpoint_.address + " port " + std::to_string(endpoint_.port);
  if (!address) {
    return fail("web: " + where + ": is not a numeric address, or its network interface is absent");
  }
  const bool is_v6 = address->family() == AF_INET6, is_secure = endpoint_.pem.has_value();
  const unsigned flags =
      static_cast<unsigned>(MHD_USE_EPOLL_INTERNAL_THREAD) | static_cast<unsigned>(MHD_USE_ITC) |
      static_cast<unsigned>(MHD_ALLOW_SUSPEND_RESUME) | static_cast<unsigned>(MHD_USE_ERROR_LOG) |
      (is_v6 ? static_cast<unsigned>(MHD_USE_DUAL_STACK) : 0U) |
      (is_secure ? static_cast<unsigned>(MHD_USE_TLS) : 0U);
  std::vector<MHD_OptionItem> tls;
  if (is_secure) {
    tls.push_back({MHD_OPTION_HTTPS_MEM_CERT, 0, endpoint_.pem->certificate.data()});
    tls.push_back({MHD_OPTION_HTTPS_MEM_KEY, 0, endpoint_.pem->key.data()});
    tls.push_back({MHD_OPTION_HTTPS_PRIORITIES, 0, const_cast<char*>(kTlsPriorities)});
  }
  tls.push_back({MHD_OPTION_END, 0, nullptr});
  // The library's own idle limit; end_overdue() acts earlier, and counts.
  const auto silence =
      std::chrono::ceil<std::chrono::seconds>(settings_.request_timeout) + std::chrono::seconds(1);
  complaint.clear();
  daemon_ = ::MHD_start_daemon(
      flags, 0, nullptr, nullptr, Callbacks::request, this, MHD_OPTION_EXTERNAL_LOGGER,
      keep_complaint, this, MHD_OPTION_SOCK_ADDR, address->get(), MHD_OPTION_THREAD_POOL_SIZE,
      kThreads, MHD_OPTION_CONNECTION_LIMIT, static_cast<unsigned>(settings_.max_connections),
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, kHeadBytes, MHD_OPTION_CONNECTION_TIMEOUT,
      static_cast<unsigned>(silence.count()), MHD_OPTION_STRICT_FOR_CLIENT, 1,
      MHD_OPTION_NOTIFY_CONNECTION, Callbacks::connection, this, MHD_OPTION_URI_LOG_CALLBACK,
      Callbacks::target, this, MHD_OPTION_NOTIFY_COMPLETED, Callbacks::completed, this,
      MHD_OPTION_ARRAY, tls.data(), MHD_OPTION_END);
  if (!daemon_) return fail("web: cannot listen on " + where + ": " + complaint);
  port_ = ::MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_BIND_PORT)->port;
  return {};
}

Server::~Server() {
  if (!daemon_) return;
  // Clients that connect from now on are refused. MHD_quiesce_daemon() would stop listening first,
  // but ends the process at random: its thread and this one both take the socket out of epoll.
  connections_.end_all();
  ::MHD_stop_daemon(daemon_);
}

void Server::end_overdue() { counts_.overdue += connections_.end_overdue(hal::Clock::now()); }

}  // namespace orbwatch::app::web
