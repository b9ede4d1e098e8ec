#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orbwatch::app::web {

/// Names and values in the order in which they were sent.
using Values = std::vector<std::pair<std::string, std::string>>;

/// The way of a request from its client. A proxy that is not trusted shows itself by its headers
/// only, and nothing that they say is believed.
enum class Passage { Direct, UntrustedProxy, TrustedProxy };

/// A request as it arrived, whole.
struct Request {
  std::string method;
  std::string target;  ///< as sent, with the query, in origin-form (RFC 9112, 3.2.1)
  std::string path;    ///< decoded, without the query
  Values query;        ///< decoded
  Values headers;
  Values cookies;
  std::string body;
  std::string peer;        ///< the client's numeric address, by a trusted proxy as that says
  bool is_secure = false;  ///< the client sent it over HTTPS
  std::string host;        ///< that the client asked, with any port; empty: HTTP/1.0 named none
  std::string prefix;      ///< the proxy's path of our root, as /cell4/orbwatch; empty: its root
  Passage passage = Passage::Direct;

  /// The first value of that name, compared exactly; null: none.
  const std::string* argument(std::string_view name) const;
  const std::string* cookie(std::string_view name) const;
  /// The first value of a header, whose name is compared in any case; null: none.
  const std::string* header(std::string_view name) const;
};

/// Bytes that several answers may share.
using Bytes = std::shared_ptr<const std::string>;

/// A body without an end. Thread rule: read and on_data by one thread at a time.
class Stream {
 public:
  virtual ~Stream() = default;
  /// `wake` is to be called when there is something to read again; any thread may call it.
  virtual void on_data(std::function<void()> wake) = 0;
  /// Writes what there is to `out`, as much as fits; returns how much, 0: nothing yet. Never waits.
  virtual std::size_t read(std::span<char> out) = 0;
};

inline constexpr std::string_view kJson = "application/json";
inline constexpr std::string_view kJpeg = "image/jpeg";
inline constexpr std::string_view kText = "text/plain; charset=utf-8";

/// An answer; with a stream it has no other body.
struct Response {
  int status = 200;
  std::string type{kJson};
  Bytes body;
  std::shared_ptr<Stream> stream;
  Values headers;  ///< besides those that every answer has
  /// Whether the client may still have the stream; asked again and again. Empty: always.
  std::function<bool()> may_go_on;
};

Response json_response(std::string text, int status = 200);
/// {"error": what}.
Response error_response(int status, const std::string& what);

}  // namespace orbwatch::app::web
