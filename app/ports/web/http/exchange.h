#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "app/ports/web/http/message.h"

struct MHD_Connection;

namespace orbwatch::app::web {

/// A request and its one answer, which may come later and from any thread; meanwhile no thread
/// waits. answer and is_answered are thread-safe.
class Exchange {
 public:
  explicit Exchange(Request request) : request_(std::move(request)) {}

  const Request& request() const { return request_; }

  /// False: it was answered before, by the server's deadline for example.
  bool answer(Response response);
  bool is_answered() const;

  /// For the server: the body that has arrived.
  std::string& body() { return request_.body; }
  /// For the server: the answer, or nullopt and the connection is suspended until it comes.
  std::optional<Response> response_or_suspend(MHD_Connection* connection);

 private:
  Request request_;
  mutable std::mutex mutex_;
  bool is_answered_ = false;
  std::optional<Response> response_;
  MHD_Connection* suspended_ = nullptr;  ///< null: not suspended
};

using ExchangePtr = std::shared_ptr<Exchange>;

}  // namespace orbwatch::app::web
