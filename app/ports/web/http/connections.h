// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/ports/web/http/exchange.h"
#include "app/ports/web/http/stream_sender.h"
#include "hal/clock.h"

namespace orbwatch::app::web {

/// Open connections, each with a deadline: a client that sends or reads one byte at a time would
/// otherwise hold its connection for ever, and the library has no timeout for suspended ones. A
/// client that reads kLeastProgress of its answer in time gets another term, but must read a file
/// at kLeastRate on average: until its end it holds the place of a deleted recording. Thread-safe.
class Connections {
 public:
  struct Connection {
    int socket = -1;
    std::string peer;
    std::string key;     ///< the peer's address_key()
    std::string client;  ///< address_key() of the client that its proxy serves; empty: none
    /// Its address exceeded the limit; shut down, and requests are ignored.
    bool is_beyond = false;
    hal::TimePoint deadline;    ///< max(): none
    bool is_answering = false;  ///< from a complete request to the end of its answer
    bool is_sending = false;    ///< an answer other than a stream is being sent
    std::uint64_t read = 0;     ///< bytes that the client had read when the term began
    bool has_gone = false;      ///< its client had disconnected at the last check
    /// Limit of `deadline` in all terms of the answer that is being sent; max(): none.
    hal::TimePoint latest_deadline;
    std::weak_ptr<Exchange> exchange;
    std::weak_ptr<StreamSender> stream;
    std::function<bool()> may_go_on;  ///< condition of the stream or file; empty: always
  };

  explicit Connections(std::chrono::milliseconds timeout) : timeout_(timeout) {}

  /// Adds an opened connection; shuts it down if its address has `most` already, which is decided
  /// here because several threads accept connections.
  Connection* add(int socket, std::string peer, std::size_t most);
  void remove(Connection* connection);

  /// Counts a proxy's connection for the client whose request it forwards, until that is answered.
  /// False: the client has `most` others.
  bool count_for(Connection* connection, const std::string& client, std::size_t most);

  /// Reports a complete request; the time limit starts again for its answer. False: the server or
  /// the connection is closing, and end_all() will not end the exchange.
  bool begin_answer(Connection* connection, const ExchangePtr& exchange);
  /// Reports that the answer is being sent. A file has a limit of its whole time, and ends when it
  /// may not continue.
  void begin_sending(Connection* connection, const Response& response);
  /// Reports that the answer is a stream: it has no deadline, and ends when it may not continue.
  /// False: the server is closing.
  bool begin_stream(Connection* connection, const std::shared_ptr<StreamSender>& stream,
                    std::function<bool()> may_go_on);
  /// Reports that the answer was sent; the time limit starts again for the next request.
  void end_answer(Connection* connection);

  /// Ends connections that are overdue, whose client has disconnected or whose stream or file may
  /// not continue; returns the number of overdue ones. A connection without a pending answer is
  /// shut down only if its client had also disconnected at the last call, because data sent before
  /// may still be read meanwhile.
  std::size_t end_overdue(hal::TimePoint now);
  /// Refuses further work, and answers pending requests. Waits until all answers are sent,
  /// including those to requests that have taken effect, for at most kLongestFlush.
  void end_all();

  static constexpr std::chrono::seconds kLongestFlush{1};
  /// Bytes of a long answer, such as a file, that a client must read in each term.
  static constexpr std::uint64_t kLeastProgress = 64 * 1024;
  /// Bytes of a file per second that a client must read on average after its first term: 4 GB in
  /// 17 h, which a link of 2 Mbit/s does in 4.5 h.
  static constexpr std::uint64_t kLeastRate = 64 * 1024;

 private:
  bool gets_another_term(Connection& connection, hal::TimePoint now) const;

  const std::chrono::milliseconds timeout_;
  std::mutex mutex_;
  std::condition_variable sent_;
  std::list<Connection> all_;
  bool is_closing_ = false;
};

}  // namespace orbwatch::app::web
