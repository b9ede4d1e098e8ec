// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "app/ports/web/http/message.h"

struct MHD_Connection;

namespace orbwatch::app::web {

/// A request and its single answer, which may be given later and from any thread; no thread waits
/// meanwhile. Thread-safe except body and response_or_suspend.
class Exchange {
 public:
  explicit Exchange(Request request) : request_(std::move(request)) {}

  const Request& request() const { return request_; }

  /// Sets Response::may_go_on of an answer that is a file and has none; called before the answer.
  void send_file_while(std::function<bool()> may_go_on);

  /// Answers the request with the response after if_none_match() and packed_for(). False: it was
  /// answered before, for example by the server's deadline.
  bool answer(Response response);
  bool is_answered() const;

  /// Marks that the request is about to take effect: from then on no deadline replaces the result,
  /// which must follow. False: it was answered already, and must not take effect.
  bool begin_effect();
  /// Answers at the server's deadline with the unchanged response. False: as answer(), or the
  /// effect has begun.
  bool give_up(Response response);

  /// The received body; for the server.
  std::string& body() { return request_.body; }
  /// The answer; nullopt: the connection is suspended until it is given. For the server.
  std::optional<Response> response_or_suspend(MHD_Connection* connection);

 private:
  Request request_;
  bool answer_locked(Response response);

  mutable std::mutex mutex_;
  bool is_answered_ = false;
  bool has_effect_ = false;
  std::function<bool()> file_may_go_on_;
  std::optional<Response> response_;
  MHD_Connection* suspended_ = nullptr;  ///< null: not suspended
};

using ExchangePtr = std::shared_ptr<Exchange>;

}  // namespace orbwatch::app::web
