#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "app/dds/bounded_queue.h"
#include "app/dds/command_counts.h"
#include "app/dds/command_request.h"
#include "app/dds/rate_limit.h"
#include "app/dds/request_ledger.h"
#include "app/dds/topic_reader.h"
#include "app/dds/topic_writer.h"
#include "hal/doorbell.h"

namespace orbwatch::app {

/// Takes commands from DDS, has each carried out once and answers it.
/// The receive thread of DDS puts requests into a bounded queue and never waits; a thread of the
/// service's own carries them out, so that pictures that wait for the network hold no command up.
/// Thread rule: one owner; counts() and statistics() are thread-safe.
class CommandService {
 public:
  /// More than these in a second are refused as Busy.
  static constexpr int kMaxPerSecond = 50;

  CommandService(const std::string& prefix, CommandHandler handler);
  ~CommandService();

  /// Reads the command topic until close(). Error: DDS refuses.
  Result<> open(const Entity& participant);
  void close();

  CommandCounts counts() const;
  const TopicReader& requests() const { return requests_; }
  const TopicWriter& results() const { return results_; }

 private:
  static constexpr std::size_t kMaxWaiting = 64;
  static constexpr std::size_t kMaxClients = 256;

  static void receive(dds_entity_t reader, void* service);
  void run();
  void serve(const CommandRequest& request);
  CommandAnswer answer_new(const CommandRequest& request);
  void send(const RequestId& id, const CommandAnswer& answer);

  const CommandHandler handler_;
  TopicReader requests_;
  TopicWriter results_;

  // Between the receive thread of DDS and the service's.
  BoundedQueue<CommandRequest, kMaxWaiting> queue_;
  hal::Doorbell wake_;
  std::atomic<bool> running_{false};

  // The service's thread only; kept from one opening to the next.
  RequestLedger ledger_{kMaxClients};
  RateLimit rate_{kMaxPerSecond, std::chrono::seconds(1)};

  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  std::atomic<std::uint64_t> repeated_{0};
  std::thread thread_;
};

}  // namespace orbwatch::app
