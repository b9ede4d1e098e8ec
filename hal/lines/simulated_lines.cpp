// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/simulated_lines.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <mutex>
#include <optional>
#include <utility>

#include "hal/lines/find_line.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {

/// One wire, shared by its input, output and simulation.
struct SimulatedLines::Wire {
  std::string name;
  OnChange on_change;
  IsConnected is_connected;
  mutable std::mutex mutex;
  bool level = false;
  bool has_input = false;
  bool has_output = false;
  std::optional<EventFd> readable;  ///< descriptor of the input while it is open
  std::array<EdgeEvent, kQueue> edges;
  std::size_t waiting = 0;
  LineFault fault = LineFault::None;

  /// Returns an error while the wire has a fault; the caller holds the mutex.
  LineResult<> check() const {
    if (is_connected && !is_connected(name)) {
      return tl::unexpected(
          LineFaultReport{LineFault::Gone, "line " + name + ": is not connected"});
    }
    if (fault == LineFault::None) return {};
    return tl::unexpected(LineFaultReport{fault, "line " + name + ": simulated fault"});
  }

  void signal() {
    if (readable) readable->signal();
  }

  void drive(bool active, TimePoint stamp) {
    const std::lock_guard lock(mutex);
    if (std::exchange(level, active) == active) return;
    if (on_change) on_change(name, active);
    if (fault != LineFault::None || !has_input || waiting == kQueue) return;
    edges[waiting++] = {edge_to(active), stamp};
    signal();
  }
};

class SimulatedLines::Input : public DigitalInput {
 public:
  Input(std::shared_ptr<Wire> wire, bool active_low)
      : wire_(std::move(wire)), active_low_(active_low) {}
  ~Input() override {
    const std::lock_guard lock(wire_->mutex);
    wire_->has_input = false;
    wire_->readable.reset();
  }

  int descriptor() const override { return wire_->readable->get(); }

  LineResult<std::size_t> take(std::span<EdgeEvent> edges) override {
    const std::lock_guard lock(wire_->mutex);
    if (auto works = wire_->check(); !works) return tl::unexpected(works.error());
    const std::size_t count = std::min(edges.size(), wire_->waiting);
    for (std::size_t i = 0; i < count; ++i) {
      const bool level = wire_->edges[i].edge == Edge::Rising;
      edges[i] = {edge_to(level != active_low_), wire_->edges[i].stamp};
    }
    const auto begin = wire_->edges.begin();
    std::move(begin + static_cast<std::ptrdiff_t>(count),
              begin + static_cast<std::ptrdiff_t>(wire_->waiting), begin);
    wire_->waiting -= count;
    if (wire_->waiting == 0) wire_->readable->clear();
    return count;
  }

  LineResult<bool> level() const override {
    const std::lock_guard lock(wire_->mutex);
    if (auto works = wire_->check(); !works) return tl::unexpected(works.error());
    return wire_->level != active_low_;
  }

  bool is_debounced() const override { return false; }

 private:
  std::shared_ptr<Wire> wire_;
  bool active_low_;
};

class SimulatedLines::Output : public DigitalOutput {
 public:
  Output(std::shared_ptr<Wire> wire, bool active_low)
      : wire_(std::move(wire)), active_low_(active_low) {
    wire_->drive(active_low_, Clock::now());
  }
  ~Output() override {
    wire_->drive(active_low_, Clock::now());
    const std::lock_guard lock(wire_->mutex);
    wire_->has_output = false;
  }

  LineResult<> set(bool active) override {
    {
      const std::lock_guard lock(wire_->mutex);
      if (auto works = wire_->check(); !works) return tl::unexpected(works.error());
    }
    wire_->drive(active != active_low_, Clock::now());
    return {};
  }

 private:
  std::shared_ptr<Wire> wire_;
  bool active_low_;
};

SimulatedLines::SimulatedLines(const std::vector<std::string>& names, const OnChange& on_change,
                               const IsConnected& is_connected) {
  for (const std::string& name : names) {
    wires_.push_back(std::make_shared<Wire>());
    wires_.back()->name = name;
    wires_.back()->on_change = on_change;
    wires_.back()->is_connected = is_connected;
  }
}

SimulatedLines::~SimulatedLines() = default;

std::vector<ChipInfo> SimulatedLines::chips() const {
  ChipInfo chip{.path = "simulated", .label = "simulated"};
  for (const auto& wire : wires_) {
    const std::lock_guard lock(wire->mutex);
    const bool is_used = wire->has_input || wire->has_output;
    chip.lines.push_back({static_cast<unsigned>(chip.lines.size()), wire->name, wire->has_output,
                          is_used, is_used ? kLineConsumer : ""});
  }
  return {chip};
}

Result<std::shared_ptr<SimulatedLines::Wire>> SimulatedLines::find(
    const LineAddress& address) const {
  const auto all = chips();
  const auto found = find_line(all, address);
  if (!found) return tl::unexpected(found.error());
  const auto& wire = wires_[found->line->offset];
  const std::lock_guard lock(wire->mutex);
  if (const auto works = wire->check(); !works) return fail(works.error().detail);
  return wire;
}

Result<std::unique_ptr<DigitalInput>> SimulatedLines::open_input(const InputSettings& settings) {
  auto wire = find(settings.address);
  if (!wire) return tl::unexpected(wire.error());
  const std::lock_guard lock((*wire)->mutex);
  if ((*wire)->has_input) {
    return fail("line " + settings.address.text() + ": is read already, by \"" + kLineConsumer +
                "\"");
  }
  (*wire)->readable.emplace();
  if (!(*wire)->readable->is_open()) {
    return fail("line " + settings.address.text() + ": too many open files");
  }
  (*wire)->has_input = true;
  (*wire)->waiting = 0;
  return std::make_unique<Input>(*wire, settings.active_low);
}

Result<std::unique_ptr<DigitalOutput>> SimulatedLines::open_output(const OutputSettings& settings) {
  auto wire = find(settings.address);
  if (!wire) return tl::unexpected(wire.error());
  {
    const std::lock_guard lock((*wire)->mutex);
    if (std::exchange((*wire)->has_output, true)) {
      return fail("line " + settings.address.text() + ": is driven already, by \"" + kLineConsumer +
                  "\"");
    }
  }
  return std::make_unique<Output>(*wire, settings.active_low);
}

SimulatedLines::Wire& SimulatedLines::wire(const std::string& line) const {
  const auto it =
      std::ranges::find_if(wires_, [&](const auto& wire) { return wire->name == line; });
  assert(it != wires_.end());
  return **it;
}

void SimulatedLines::drive(const std::string& line, bool level, TimePoint stamp) {
  wire(line).drive(level, stamp);
}

bool SimulatedLines::level(const std::string& line) const {
  const Wire& found = wire(line);
  const std::lock_guard lock(found.mutex);
  return found.level;
}

void SimulatedLines::fail_with(const std::string& line, LineFault fault) {
  Wire& found = wire(line);
  const std::lock_guard lock(found.mutex);
  if (std::exchange(found.fault, fault) != fault) found.signal();
}

}  // namespace orbwatch::hal
