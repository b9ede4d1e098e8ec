// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/commands/request_ledger.h"
#include "app/ports/dds/participant/rate_limit.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "app/state/command_record.h"
#include "hal/thread/bounded_queue.h"

namespace orbwatch::app::dds {

/// Receives commands over DDS, executes each at most once and answers it. The receive thread of DDS
/// puts requests into a bounded queue and never waits; the owner's thread executes them.
/// Thread rule: one owner; counts() is thread-safe.
class CommandService {
 public:
  /// Limit of commands per second; further ones are refused as Busy.
  static constexpr int kMaxPerSecond = 50;

  /// `record` outlives this; requests in it are not executed again. `wake` is called on the receive
  /// thread of DDS when there are requests to serve.
  CommandService(const std::string& prefix, CommandHandler handler, CommandRecord& record,
                 std::function<void()> wake);
  ~CommandService();

  /// Reads the command topic until close(). Error: a failure of DDS.
  Result<> open(const Entity& participant);
  /// Executes the received requests.
  void serve();
  /// Executes the received requests, then closes the topics.
  void close();

  CommandCounts counts() const;
  const TopicReader& requests() const { return requests_; }
  const TopicWriter& results() const { return results_; }

 private:
  static constexpr std::size_t kMaxWaiting = 64;

  static void receive(dds_entity_t reader, void* service);
  void serve(const CommandRequest& request);
  CommandAnswer answer_new(const CommandRequest& request);
  void send(const RequestId& id, const CommandAnswer& answer);

  const CommandHandler handler_;
  const std::function<void()> wake_;
  CommandRecord& record_;
  TopicReader requests_;
  TopicWriter results_;

  // Shared by the receive thread of DDS and the owner's.
  hal::BoundedQueue<CommandRequest, kMaxWaiting> queue_;

  // Used by the owner's thread only; kept across open() and close().
  RequestLedger ledger_{CommandRecord::kMaxClients};
  RateLimit rate_{kMaxPerSecond, std::chrono::seconds(1)};

  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> repeated_{0};
};

}  // namespace orbwatch::app::dds
