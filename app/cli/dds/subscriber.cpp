// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/subscriber.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <ostream>
#include <set>

#include "app/cli/dds/writer_types.h"
#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/topics/topic_names.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "hal/clock.h"

namespace orbwatch::app::cli {

namespace {

constexpr std::chrono::milliseconds kCancelPeriod{100};
constexpr std::chrono::seconds kLinePeriod{1};
constexpr hal::Clock::duration kNoTime{0};
/// About thirty years; more might overflow the clock.
constexpr double kMaxSeconds = 1e9;

using Subscriptions = std::vector<std::unique_ptr<Subscription>>;

Result<Subscriptions> make_subscriptions(const SubscribeOptions& options) {
  std::vector<std::string> topics = options.topics;
  if (topics.empty()) {
    topics = {dds::image_topic(options.prefix, dds::kSelectedView),
              dds::process_state_topic(options.prefix)};
  }
  Subscriptions subscriptions;
  std::set<std::string> stems;
  for (const auto& name : topics) {
    const std::string topic = full_topic(name);
    if (!stems.insert(file_stem(topic, options.prefix)).second) {
      return fail("DDS: topic " + topic + " is named twice, or its file name is another's");
    }
    subscriptions.push_back(Subscription::make(topic, !options.save.empty()));
  }
  return subscriptions;
}

/// Opens all of them; returns a wait set that wakes when any has data.
Result<dds::Entity> open(const Subscriptions& subscriptions, const dds::Entity& participant) {
  std::vector<dds_entity_t> readers;
  for (const auto& subscription : subscriptions) {
    if (const auto opened = subscription->open(participant); !opened) {
      return tl::unexpected(opened.error());
    }
    readers.push_back(subscription->reader().get());
  }
  return make_wait_set(participant, readers);
}

/// Times of the next line and of the end.
class Schedule {
 public:
  explicit Schedule(double seconds) : start_(hal::Clock::now()), line_(start_) {
    if (seconds > 0 && seconds < kMaxSeconds) {
      end_ = start_ + std::chrono::duration_cast<hal::Clock::duration>(
                          std::chrono::duration<double>(seconds));
    }
  }

  bool over(hal::TimePoint now) const { return now >= end_; }

  hal::Clock::duration wait(hal::TimePoint now) const {
    const hal::Clock::duration next =
        std::min<hal::Clock::duration>(kCancelPeriod, line_ + kLinePeriod - now);
    return std::min(next, end_ - now);
  }

  /// Returns the seconds since the last line when one is due.
  std::optional<double> line_due(hal::TimePoint now) {
    if (now - line_ < kLinePeriod) return std::nullopt;
    const std::chrono::duration<double> passed = now - line_;
    line_ = now;
    return passed.count();
  }

 private:
  hal::TimePoint start_;
  hal::TimePoint line_;
  hal::TimePoint end_ = hal::TimePoint::max();
};

bool has_enough(const Subscriptions& subscriptions, int count) {
  return count > 0 && std::ranges::all_of(subscriptions, [&](const auto& subscription) {
           return subscription->report().received >= static_cast<std::uint64_t>(count);
         });
}

/// Error: one of the topics is written with a type other than the type that reads it.
Result<> check_types(const Subscriptions& subscriptions, WriterTypes& types) {
  const auto now = hal::Clock::now();
  if (const auto updated = types.update(now); !updated) return updated;
  for (const auto& subscription : subscriptions) {
    const std::string type = types.unreadable(subscription->reader(), now);
    if (type.empty()) continue;
    return fail("DDS: topic " + subscription->report().topic + " has the type " + type_text(type) +
                ", which cannot be read here: " + readable_types());
  }
  return {};
}

Result<> read(const Subscriptions& subscriptions, WriterTypes& types, const dds::Entity& wait_set,
              const SubscribeOptions& options, const std::atomic<bool>& cancelled,
              std::ostream& out) {
  const auto print = [&](const auto& item) {
    out << (options.json ? topic_json(item) : topic_line(item)) << '\n';
  };
  std::function<void(const TopicSample&)> each;
  if (options.each) each = print;
  Schedule schedule(options.seconds);
  for (bool last = false; !last;) {
    const auto now = hal::Clock::now();
    // Reads once more after the end, for samples that have arrived by then.
    last = cancelled || schedule.over(now) || has_enough(subscriptions, options.count);
    const auto waited = wait_for_data(wait_set, last ? kNoTime : schedule.wait(now));
    if (!waited) return tl::unexpected(waited.error());
    for (const auto& subscription : subscriptions) {
      if (const auto taken = subscription->take(each); !taken) return taken;
    }
    if (const auto checked = check_types(subscriptions, types); !checked) return checked;
    if (options.each) out.flush();
    const auto seconds = schedule.line_due(hal::Clock::now());
    if (!seconds || !options.stats) continue;
    for (const auto& subscription : subscriptions) print(subscription->figures(*seconds));
    out.flush();
  }
  return {};
}

Result<> save(const Subscriptions& subscriptions, const SubscribeOptions& options) {
  if (options.save.empty()) return {};
  for (const auto& subscription : subscriptions) {
    if (const auto saved = subscription->save(options.save, options.prefix); !saved) return saved;
  }
  return {};
}

Result<> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) return fail(folder.string() + ": cannot be made: " + error.message());
  return {};
}

}  // namespace

Result<std::vector<TopicReport>> subscribe(const SubscribeOptions& options,
                                           const std::atomic<bool>& cancelled, std::ostream& out) {
  dds::limit_dds_log();
  if (const auto made = make_folder(options.save); !made) return tl::unexpected(made.error());
  const auto participant = dds::Participant::join(options.domain, options.security);
  if (!participant) return tl::unexpected(participant.error());
  const auto subscriptions = make_subscriptions(options);
  if (!subscriptions) return tl::unexpected(subscriptions.error());

  WriterTypes types;
  const auto done = types.open(participant->entity())
                        .and_then([&] { return open(*subscriptions, participant->entity()); })
                        .and_then([&](const dds::Entity& wait_set) {
                          return read(*subscriptions, types, wait_set, options, cancelled, out);
                        })
                        .and_then([&] { return save(*subscriptions, options); });
  if (!done) return tl::unexpected(done.error());

  std::vector<TopicReport> reports;
  for (const auto& subscription : *subscriptions) reports.push_back(subscription->report());
  return reports;
}

}  // namespace orbwatch::app::cli
