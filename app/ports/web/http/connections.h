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

/// The open connections with a deadline each: what a client sends or reads a byte at a time would
/// otherwise stay for ever, and the library has no timeout for suspended ones. Thread-safe.
class Connections {
 public:
  struct Connection {
    int socket = -1;
    std::string peer;
    std::string key;            ///< the peer's address_key()
    std::string client;         ///< address_key() of the client whom its proxy serves; empty: none
    bool is_beyond = false;     ///< its address had enough; shut down, and nothing is asked of it
    hal::TimePoint deadline;    ///< max(): none
    bool is_answering = false;  ///< from a request that is whole to the end of its answer
    bool has_gone = false;      ///< its client had at the last look
    std::weak_ptr<Exchange> exchange;
    std::weak_ptr<StreamSender> stream;
    std::function<bool()> may_go_on;  ///< of the stream; empty: always
  };

  explicit Connections(std::chrono::milliseconds timeout) : timeout_(timeout) {}

  /// Notes one that was opened; shuts it down when its address has `most`, which is decided here
  /// since several threads take connections at once.
  Connection* add(int socket, std::string peer, std::size_t most);
  void remove(Connection* connection);

  /// Counts a proxy's connection for the client whose request it passes on, until that is
  /// answered. False: the client has `most` others.
  bool count_for(Connection* connection, const std::string& client, std::size_t most);

  /// Its request has arrived whole, and the answer has as long. False: the server or the connection
  /// is closing, and the exchange will not be ended by end_all().
  bool begin_answer(Connection* connection, const ExchangePtr& exchange);
  /// Its answer is being sent.
  void begin_sending(Connection* connection);
  /// Its answer is a stream: it has no deadline, and ends once it may not go on. False: the server
  /// is closing.
  bool begin_stream(Connection* connection, const std::shared_ptr<StreamSender>& stream,
                    std::function<bool()> may_go_on);
  /// Its answer was sent; the next request has as long.
  void end_answer(Connection* connection);

  /// Ends connections that are overdue, whose client has gone or whose stream may not go on;
  /// returns how many were overdue. One that waits for no answer is shut down when its client had
  /// gone at the last call, too: what was sent before may still be read meanwhile.
  std::size_t end_overdue(hal::TimePoint now);
  /// Refuses more work, and answers what waits for its answer. Waits until all answers are sent,
  /// those to requests that have taken effect as well, for kLongestFlush at most.
  void end_all();

  static constexpr std::chrono::seconds kLongestFlush{1};

 private:
  const std::chrono::milliseconds timeout_;
  std::mutex mutex_;
  std::condition_variable sent_;
  std::list<Connection> all_;
  bool is_closing_ = false;
};

}  // namespace orbwatch::app::web
