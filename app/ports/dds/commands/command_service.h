#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "app/ports/dds/commands/bounded_queue.h"
#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/commands/request_ledger.h"
#include "app/ports/dds/participant/rate_limit.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "app/state/command_record.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Receives commands over DDS, carries each out at most once and answers it.
/// The receive thread of DDS puts requests into a bounded queue and never waits; the service's own
/// thread carries them out, so that pictures blocked by the network delay no command.
/// Thread rule: one owner; counts() and statistics() are thread-safe.
class CommandService {
 public:
  /// More than these in a second are refused as Busy.
  static constexpr int kMaxPerSecond = 50;

  /// `record` outlives this; requests in it are not carried out again.
  CommandService(const std::string& prefix, CommandHandler handler, CommandRecord& record);
  ~CommandService();

  /// Reads the command topic until close(). Error: DDS refuses.
  Result<> open(const Entity& participant);
  void close();

  CommandCounts counts() const;
  const TopicReader& requests() const { return requests_; }
  const TopicWriter& results() const { return results_; }

 private:
  static constexpr std::size_t kMaxWaiting = 64;

  static void receive(dds_entity_t reader, void* service);
  void run();
  void serve(const CommandRequest& request);
  CommandAnswer answer_new(const CommandRequest& request);
  void send(const RequestId& id, const CommandAnswer& answer);

  const CommandHandler handler_;
  CommandRecord& record_;
  TopicReader requests_;
  TopicWriter results_;

  // Between the receive thread of DDS and the service's.
  BoundedQueue<CommandRequest, kMaxWaiting> queue_;

  // The service's thread only; kept when it is opened again.
  RequestLedger ledger_{CommandRecord::kMaxClients};
  RateLimit rate_{kMaxPerSecond, std::chrono::seconds(1)};

  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> repeated_{0};
  hal::Thread thread_;
};

}  // namespace orbwatch::app
