// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/reply.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace orbwatch::app::web {
namespace {

/// Largest block that libmicrohttpd reads from a stream at once.
constexpr std::size_t kStreamBlock = 128 * 1024;

/// Headers of every answer: no resources of other origins, no inline scripts, no framing.
constexpr std::array<std::pair<const char*, const char*>, 8> kHeaders{
    {{"Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
      "connect-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"},
     {"X-Content-Type-Options", "nosniff"},
     {"X-Frame-Options", "DENY"},
     {"Referrer-Policy", "no-referrer"},
     {"Cross-Origin-Resource-Policy", "same-origin"},
     {"Cross-Origin-Opener-Policy", "same-origin"},
     {"Permissions-Policy", "camera=(), microphone=(), geolocation=()"},
     {"Server", "orbwatch"}}};

/// Adds headers; null: out of memory.
Reply with_headers(Reply reply, const Response& response, const Values& more) {
  const auto add = [&reply](const char* name, const char* value) {
    return ::MHD_add_response_header(reply.get(), name, value) == MHD_YES;
  };
  if (!reply) return reply;
  bool added = add(MHD_HTTP_HEADER_CONTENT_TYPE, response.type.c_str());
  for (const auto& [name, value] : kHeaders) added = added && add(name, value);
  if (response.tag.empty()) {
    added = added && add(MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
  } else {
    // Kept by clients, and revalidated before each use.
    added = added && add(MHD_HTTP_HEADER_CACHE_CONTROL, "no-cache") &&
            add(MHD_HTTP_HEADER_ETAG, response.tag.c_str());
  }
  for (const Values* headers : {&response.headers, &more}) {
    for (const auto& [name, value] : *headers) added = added && add(name.c_str(), value.c_str());
  }
  return added ? std::move(reply) : nullptr;
}

struct StreamBody {
  std::shared_ptr<StreamSender> sender;
  std::function<void()> on_end;
};

ssize_t read_stream(void* body, std::uint64_t /*position*/, char* out, std::size_t most) {
  return static_cast<StreamBody*>(body)->sender->read(out, most);
}

void end_stream(void* body) {
  const std::unique_ptr<StreamBody> owned(static_cast<StreamBody*>(body));
  owned->on_end();
}

void release_bytes(void* bytes) { delete static_cast<Bytes*>(bytes); }

/// Null: out of memory, or of files. libmicrohttpd closes its own descriptor.
Reply file_reply(const OpenFile& opened) {
  const int file = ::fcntl(opened.file.get(), F_DUPFD_CLOEXEC, 0);
  if (file < 0) return nullptr;
  Reply reply(::MHD_create_response_from_fd64(opened.size, file));
  if (!reply) ::close(file);
  return reply;
}

}  // namespace

Reply make_reply(const Response& response, const Values& more) {
  if (response.file) return with_headers(file_reply(*response.file), response, more);
  if (!response.body) {
    return with_headers(
        Reply(::MHD_create_response_from_buffer(0, nullptr, MHD_RESPMEM_PERSISTENT)), response,
        more);
  }
  auto owned = std::make_unique<Bytes>(response.body);
  // The C API takes a non-const pointer, but only reads.
  Reply reply(::MHD_create_response_from_buffer_with_free_callback_cls(
      response.body->size(), const_cast<char*>(response.body->data()), release_bytes, owned.get()));
  if (reply) static_cast<void>(owned.release());
  return with_headers(std::move(reply), response, more);
}

Reply make_reply(const Response& response, const Values& more, std::shared_ptr<StreamSender> sender,
                 std::function<void()> on_end) {
  auto owned = std::make_unique<StreamBody>(StreamBody{std::move(sender), std::move(on_end)});
  Reply reply(::MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock, read_stream,
                                                  owned.get(), end_stream));
  if (!reply) {
    owned->on_end();
    return nullptr;
  }
  static_cast<void>(owned.release());
  // Avoids chunks, which would be limited to the connection's small pool, and which MJPEG players
  // do not expect.
  ::MHD_set_response_options(reply.get(), MHD_RF_HTTP_1_0_COMPATIBLE_STRICT, MHD_RO_END);
  return with_headers(std::move(reply), response, more);
}

}  // namespace orbwatch::app::web
