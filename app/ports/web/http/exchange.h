#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "app/ports/web/http/message.h"

struct MHD_Connection;

namespace orbwatch::app::web {

/// A request and its one answer, which may come later and from any thread; meanwhile no thread
/// waits. Thread-safe but for body and response_or_suspend.
class Exchange {
 public:
  explicit Exchange(Request request) : request_(std::move(request)) {}

  const Request& request() const { return request_; }

  /// False: it was answered before, by the server's deadline for example.
  bool answer(Response response);
  bool is_answered() const;

  /// Marks that the request is about to take effect: no deadline answers in place of the result
  /// any more, which must follow. False: it was answered, and the effect must not come.
  bool begin_effect();
  /// Answers by the server's deadline, see answer(). False also once the effect has begun.
  bool give_up(Response response);

  /// For the server: the body that has arrived.
  std::string& body() { return request_.body; }
  /// For the server: the answer, or nullopt and the connection is suspended until it comes.
  std::optional<Response> response_or_suspend(MHD_Connection* connection);

 private:
  Request request_;
  bool answer_locked(Response response);

  mutable std::mutex mutex_;
  bool is_answered_ = false;
  bool has_effect_ = false;
  std::optional<Response> response_;
  MHD_Connection* suspended_ = nullptr;  ///< null: not suspended
};

using ExchangePtr = std::shared_ptr<Exchange>;

}  // namespace orbwatch::app::web
