// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/commands/request_ledger.h"
#include "app/ports/dds/participant/rate_limit.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "app/state/command_record.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::dds {

/// Receives commands over DDS, executes each at most once and answers it. The receive thread of DDS
/// puts requests into a bounded queue and never waits. A thread of the service executes them, since
/// a command waits for the disk and the handler.
/// Thread rule: one owner; counts(), cpu_time() and the topics' statistics are thread-safe.
class CommandService {
 public:
  /// Limit of commands per second; further ones are refused as Busy.
  static constexpr int kMaxPerSecond = 50;

  /// `record` outlives this; requests in it are not executed again. `handler` is called on the
  /// service's thread, and on the owner's in close().
  CommandService(const std::string& prefix, CommandHandler handler, CommandRecord& record);
  ~CommandService();

  /// Reads the command topic and executes its requests until close(). Error: a failure of DDS.
  Result<> open(const Entity& participant);
  /// Executes the received requests, waiting for one that is being executed, then closes the
  /// topics.
  void close();

  CommandCounts counts() const;
  std::chrono::nanoseconds cpu_time() const { return thread_.cpu_time(); }
  const TopicReader& requests() const { return requests_; }
  const TopicWriter& results() const { return results_; }

 private:
  static constexpr std::size_t kMaxWaiting = 64;

  static void receive(dds_entity_t reader, void* service);
  void serve_all();
  void serve(const CommandRequest& request);
  CommandAnswer answer_new(const CommandRequest& request);
  void send(const RequestId& id, const CommandAnswer& answer);

  const CommandHandler handler_;
  CommandRecord& record_;
  TopicReader requests_;
  TopicWriter results_;

  // Shared by the receive thread of DDS and the one that executes.
  hal::BoundedQueue<CommandRequest, kMaxWaiting> queue_;

  // Used by the service's thread while it runs, else by the owner; kept across open() and close().
  RequestLedger ledger_{CommandRecord::kMaxClients};
  RateLimit rate_{kMaxPerSecond, std::chrono::seconds(1)};

  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> repeated_{0};
  hal::Thread thread_;
};

}  // namespace orbwatch::app::dds
