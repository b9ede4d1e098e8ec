#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "app/ports/dds/commands/bounded_queue.h"
#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/commands/request_ledger.h"
#include "app/ports/dds/participant/rate_limit.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "app/state/command_record.h"

namespace orbwatch::app {

/// Receives commands over DDS, carries each out at most once and answers it.
/// The receive thread of DDS puts requests into a bounded queue and never waits; the owner's thread
/// carries them out.
/// Thread rule: one owner; counts() is thread-safe.
class CommandService {
 public:
  /// More than these in a second are refused as Busy.
  static constexpr int kMaxPerSecond = 50;

  /// `record` outlives this; requests in it are not carried out again. `wake` is called on the
  /// receive thread of DDS when there is something to serve.
  CommandService(const std::string& prefix, CommandHandler handler, CommandRecord& record,
                 std::function<void()> wake);
  ~CommandService();

  /// Reads the command topic until close(). Error: DDS refuses.
  Result<> open(const Entity& participant);
  /// Carries out what was received.
  void serve();
  /// Carries out what was received before.
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

  // Between the receive thread of DDS and the owner's.
  BoundedQueue<CommandRequest, kMaxWaiting> queue_;

  // The owner's thread only; kept when it is opened again.
  RequestLedger ledger_{CommandRecord::kMaxClients};
  RateLimit rate_{kMaxPerSecond, std::chrono::seconds(1)};

  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> repeated_{0};
};

}  // namespace orbwatch::app
