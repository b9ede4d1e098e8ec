// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/ports/web/http/open_file.h"

namespace orbwatch::app::web {

/// Names and values in the order sent.
using Values = std::vector<std::pair<std::string, std::string>>;

/// Path of a request from its client. An untrusted proxy is detected by its headers, whose values
/// are ignored.
enum class Passage { Direct, UntrustedProxy, TrustedProxy };

/// A complete request as received.
struct Request {
  std::string method;
  std::string target;  ///< request target with the query, in origin-form (RFC 9112, 3.2.1)
  std::string path;    ///< decoded, without the query
  Values query;        ///< decoded
  Values headers;
  Values cookies;
  std::string body;
  std::string peer;  ///< the client's numeric address, for a trusted proxy the one that it states
  bool is_secure = false;  ///< the client sent it over HTTPS
  std::string host;    ///< host requested by the client, with a port if any; empty: none (HTTP/1.0)
  std::string prefix;  ///< path of our root at the proxy, such as /cell4/orbwatch; empty: its root
  Passage passage = Passage::Direct;

  /// First value of this name, compared exactly; null: none.
  const std::string* argument(std::string_view name) const;
  const std::string* cookie(std::string_view name) const;
  /// First value of a header, whose name is compared case-insensitively; null: none.
  const std::string* header(std::string_view name) const;
};

/// Bytes that may be shared by several answers.
using Bytes = std::shared_ptr<const std::string>;

/// A body without an end. Thread rule: read and on_data on one thread at a time.
class Stream {
 public:
  virtual ~Stream() = default;
  /// Sets `wake`, to be called on any thread when there is data to read again.
  virtual void on_data(std::function<void()> wake) = 0;
  /// Writes available data to `out`, as much as fits; returns the number of bytes, 0: none yet.
  /// Never waits.
  virtual std::size_t read(std::span<char> out) = 0;
};

inline constexpr std::string_view kJson = "application/json";
inline constexpr std::string_view kJpeg = "image/jpeg";
inline constexpr std::string_view kText = "text/plain; charset=utf-8";

/// An answer, with one body of three kinds.
struct Response {
  int status = 200;
  std::string type{kJson};
  Bytes body;
  std::shared_ptr<const OpenFile> file{};
  std::string tag{};  ///< entity_tag() of the content, if clients may keep it; empty: they may not
  std::shared_ptr<Stream> stream;
  Values headers;  ///< in addition to those of every answer
  /// Returns whether the client may still receive the stream or file; called repeatedly. Empty:
  /// always.
  std::function<bool()> may_go_on;
};

Response body_response(std::string_view type, Bytes body, int status = 200);
Response body_response(std::string_view type, std::string body, int status = 200);
Response file_response(std::string_view type, std::shared_ptr<const OpenFile> file);
Response json_response(std::string text, int status = 200);
/// Response with the body {"error": what}.
Response error_response(int status, const std::string& what);

}  // namespace orbwatch::app::web
