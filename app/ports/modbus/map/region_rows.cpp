// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "app/model/status/condition.h"
#include "app/ports/modbus/map/block.h"
#include "app/ports/modbus/map/rows.h"

/// A region begins with a block that one request reads: the conditions of the measurement, a valid
/// bit per signal, the signals. Further signals continue in further blocks, which repeat the number
/// of the measurement.
namespace orbwatch::app::modbus {
namespace {

constexpr int kMoreHeader = 4;
constexpr int kMoreStride = 128;

/// Signals of each further block.
constexpr std::size_t kMoreSignals = (kMaxReadRegisters - kMoreHeader - kValidWords) / 2;
constexpr std::size_t kMoreBlocks = kMoreOfRegions.stride / kMoreStride;

static_assert(16 * kValidWords >= kFirstSignals && 16 * kValidWords >= kMoreSignals);
static_assert(signals::kSignals.size() <= kFirstSignals + kMoreBlocks * kMoreSignals);
static_assert(kRegions.has_room_for(signals::kMaxRegions) &&
              kResults.has_room_for(signals::kMaxRegions));
static_assert(kMoreOfRegions.has_room_for(signals::kMaxRegions) &&
              kMoreOfResults.has_room_for(signals::kMaxRegions));

/// The live measurement or the oldest result: the same structure at two places.
struct Window {
  std::string_view prefix;
  Series first;
  Series more;
  StampedStatus ProcessImage::*source;
};
constexpr std::array kWindows{Window{"region_", kRegions, kMoreOfRegions, &ProcessImage::live},
                              Window{"result_", kResults, kMoreOfResults, &ProcessImage::result}};

using SignalField = Field<SignalOf>;

std::vector<SignalField> make_signals() {
  std::vector<SignalField> fields;
  for_each_field(std::type_identity<RegionStatus>{}, [&fields](const auto& field) {
    if constexpr (std::is_same_v<decltype(field), const SignalField&>) fields.push_back(field);
  });
  return fields;
}

/// All signals, in the order of their numbers.
const std::vector<SignalField>& all_signals() {
  static const std::vector<SignalField> fields = make_signals();
  return fields;
}

/// Bit n: signal first + n has a value.
std::uint32_t valid_word(const RegionStatus& region, std::size_t first, std::size_t end) {
  std::uint32_t word = 0;
  for (std::size_t i = first; i < std::min(end, first + 16); ++i) {
    const SignalField& signal = all_signals()[i];
    if (encoded(signal.get(region), signal) != kNotValidCode) word |= 1U << (i - first);
  }
  return word;
}

/// Builds one block of one region.
class RegionBlock {
 public:
  RegionBlock(std::vector<Row>& rows, const Window& window, std::size_t region, Section section)
      : region_(region),
        stamped_(rows, Table::Input, section, prefix(window, region),
                 [source = window.source](const ProcessImage& image) -> const StampedStatus& {
                   return image.*source;
                 }) {}

  /// Adds the rows that identify the measurement.
  RegionBlock& number(const std::string& tag = {}) {
    system(&Status::result, "Number of the result; live, of the newest one; 0: none", tag);
    return system(&Status::frame_set, "Number of the measured frame set", tag);
  }

  /// Adds the conditions of the measurement.
  RegionBlock& conditions() {
    using S = const StampedStatus&;
    using I = const ProcessImage&;
    stamped_
        .row(Type::Udint, "utc_seconds", {"s", 1, 0, 4294967295},
             "UTC of its exposure start, seconds since 1970; 0: none yet",
             [](S s, I) { return s.utc.count() / 1000000; })
        .row(Type::Udint, "utc_microseconds", {"us", 1, 0, 999999}, "Microseconds in that second",
             [](S s, I) { return s.utc.count() % 1000000; });
    system(&Status::trigger, "Number of the trigger that began it; 0: not triggered");
    system(&Status::configuration_checksum, "CRC-32 of all configuration files at that time");
    system(&Status::recipe, "Number of the recipe that measured it");
    stamped_.row(Type::Uint, "quality", code_range<Quality>(), listed_codes<Quality>(),
                 [r = region_](S s, I) { return static_cast<int>(s.status.regions[r].quality); });
    system(&Status::process_active, "The process was active");
    stamped_.row(Type::Uint, "alarm_severity", code_range<Severity>(),
                 "Severity of the worst active alarm of this region: " + listed_codes<Severity>(),
                 [r = region_](S s, I) { return static_cast<int>(worst_severity(s.status, r)); });
    return *this;
  }

  /// Adds signals [first, end), and a valid bit for each.
  RegionBlock& signal_rows(std::size_t first, std::size_t end) {
    using S = const StampedStatus&;
    for (std::size_t word = first; word < first + 16 * kValidWords; word += 16) {
      const std::string number = std::to_string(word);
      stamped_.row(Type::Uint, "valid_" + number, kWord,
                   "Bit n: signal " + number + " + n has a value",
                   [r = region_, word, end](S s, const ProcessImage&) {
                     return valid_word(s.status.regions[r], word, end);
                   });
    }
    for (std::size_t i = first; i < end; ++i) {
      const SignalField& signal = all_signals()[i];
      stamped_.row(Type::Dint, signal.name, signal, std::string(signal.description),
                   [r = region_, &signal](S s, const ProcessImage&) {
                     return encoded(signal.get(s.status.regions[r]), signal);
                   });
    }
    return *this;
  }

 private:
  static std::string prefix(const Window& window, std::size_t region) {
    return std::string(window.prefix) + std::to_string(region) + "_";
  }

  /// The row of a member of the status; its name and type are those of the member's field.
  template <class Value>
  RegionBlock& system(Value SystemStatus::*member, std::string description,
                      const std::string& tag = {}) {
    for_each_field(std::type_identity<SystemStatus>{}, [&](const auto& field) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field.get)>,
                                   Value SystemStatus::*>) {
        if (field.get != member) return;
        stamped_.row(
            type_of<Value>(), tag + std::string(field.name), field, description,
            [member](const StampedStatus& s, const ProcessImage&) { return s.status.*member; });
      }
    });
    return *this;
  }

  std::size_t region_;
  Block<StampedStatus> stamped_;
};

void add_region(std::vector<Row>& rows, const Window& window, std::size_t region) {
  const std::size_t count = all_signals().size();
  RegionBlock(rows, window, region, window.first.entry(region))
      .number()
      .conditions()
      .signal_rows(0, std::min(count, kFirstSignals));
  for (std::size_t block = 1, first = kFirstSignals; first < count; ++block) {
    const std::size_t end = std::min(count, first + kMoreSignals);
    const int begin = window.more.entry(region).begin + static_cast<int>(block - 1) * kMoreStride;
    RegionBlock(rows, window, region, {begin, begin + kMoreStride})
        .number("more_" + std::to_string(block) + "_")
        .signal_rows(first, end);
    first = end;
  }
}

}  // namespace

void add_region_rows(std::vector<Row>& rows) {
  for (const Window& window : kWindows) {
    for (std::size_t r = 0; r < signals::kMaxRegions; ++r) add_region(rows, window, r);
  }
}

}  // namespace orbwatch::app::modbus
