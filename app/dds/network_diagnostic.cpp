#include "app/dds/network_diagnostic.h"

#include <string>

namespace orbwatch::app {
namespace {

class Counters {
 public:
  explicit Counters(Diagnostic& diagnostic) : diagnostic_(diagnostic) {}

  void normal(const std::string& name, std::uint64_t count) {
    if (count > 0) diagnostic_.values.emplace_back(name, std::to_string(count));
  }
  /// One that asks for attention.
  void bad(const std::string& name, std::uint64_t count, std::string_view message) {
    normal(name, count);
    if (count == 0 || diagnostic_.level == DiagnosticLevel::Warn) return;
    diagnostic_.level = DiagnosticLevel::Warn;
    diagnostic_.message = message;
  }

 private:
  Diagnostic& diagnostic_;
};

}  // namespace

Diagnostic diagnose_network(const DdsStatistics& network) {
  Diagnostic diagnostic{DiagnosticLevel::Ok, "orbwatch: network", "since start", {}};
  Counters counters(diagnostic);
  counters.normal("joins", network.joins);
  counters.normal("dropped_states", network.dropped_states);
  counters.bad("dropped_notices", network.dropped_notices, "events were lost");
  counters.bad("unknown_views", network.unknown_views, "views have no topic");
  counters.bad("mistyped", network.mistyped, "somebody uses a topic of ours with another type");
  counters.bad("malformed", network.malformed, "somebody sends what does not fit its type");
  for (const TopicStatistics& topic : network.topics) {
    counters.normal(topic.topic + " written", topic.written);
    counters.normal(topic.topic + " unread", topic.unread);
    counters.normal(topic.topic + " replaced", topic.replaced);
    counters.normal(topic.topic + " limited", topic.limited);
    counters.bad(topic.topic + " blocked", topic.blocked, "a reader does not keep up");
    counters.bad(topic.topic + " failed", topic.failed, topic.last_error);
  }
  return diagnostic;
}

}  // namespace orbwatch::app
