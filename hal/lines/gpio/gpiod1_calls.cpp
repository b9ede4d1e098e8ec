// SPDX-License-Identifier: Apache-2.0
// libgpiod 1.6, the kernel's line interface v1: no debounce, no edge numbers.
#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "hal/lines/gpio/gpiod_calls.h"

namespace orbwatch::hal::gpiod_calls {
namespace {

using Chip = std::unique_ptr<gpiod_chip, decltype(&gpiod_chip_close)>;

std::string text_of(const char* text) { return text ? text : ""; }

int flags(bool active_low, LineBias bias) {
  int flags = active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (bias == LineBias::Disabled) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
  if (bias == LineBias::PullUp) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  if (bias == LineBias::PullDown) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  return flags;
}

/// A line of an open chip, released with it.
class Requested {
 public:
  static tl::expected<Requested, int> make(const std::string& path, unsigned offset, int type,
                                           int flags) {
    Requested requested{Chip(gpiod_chip_open(path.c_str()), gpiod_chip_close)};
    if (!requested.chip_) return tl::unexpected(errno);
    requested.line_ = gpiod_chip_get_line(requested.chip_.get(), offset);
    if (!requested.line_) return tl::unexpected(errno);
    const gpiod_line_request_config config{kLineConsumer, type, flags};
    if (gpiod_line_request(requested.line_, &config, 0) != 0) return tl::unexpected(errno);
    return requested;
  }
  gpiod_line* line() const { return line_; }

 private:
  explicit Requested(Chip chip) : chip_(std::move(chip)) {}
  Chip chip_;  // closing it releases its lines
  gpiod_line* line_ = nullptr;
};

class Input : public DigitalInput {
 public:
  Input(Requested requested, std::string text)
      : requested_(std::move(requested)), text_(std::move(text)) {}

  int descriptor() const override { return gpiod_line_event_get_fd(requested_.line()); }

  LineResult<std::size_t> take(std::span<EdgeEvent> edges) override {
    std::array<gpiod_line_event, 16> events;
    const auto most = static_cast<unsigned>(std::min(events.size(), edges.size()));
    const int count = gpiod_line_event_read_fd_multiple(descriptor(), events.data(), most);
    if (count < 0 && errno == EAGAIN) return 0;
    if (count < 0) return tl::unexpected(line_fault(text_, errno));
    for (int i = 0; i < count; ++i) edges[static_cast<std::size_t>(i)] = edge_of(events[i]);
    return static_cast<std::size_t>(count);
  }

  LineResult<bool> level() const override {
    const int value = gpiod_line_get_value(requested_.line());
    if (value < 0) return tl::unexpected(line_fault(text_, errno));
    return value == 1;
  }

  bool is_debounced() const override { return false; }

 private:
  static EdgeEvent edge_of(const gpiod_line_event& event) {
    const Edge edge = edge_to(event.event_type == GPIOD_LINE_EVENT_RISING_EDGE);
    const auto age =
        std::chrono::seconds(event.ts.tv_sec) + std::chrono::nanoseconds(event.ts.tv_nsec);
    return {edge, TimePoint(age)};
  }

  Requested requested_;
  std::string text_;
};

class Output : public DigitalOutput {
 public:
  Output(Requested requested, std::string text)
      : requested_(std::move(requested)), text_(std::move(text)) {}
  // This fails when the chip is gone; nothing is left to do then.
  ~Output() override { static_cast<void>(gpiod_line_set_value(requested_.line(), 0)); }

  LineResult<> set(bool active) override {
    if (gpiod_line_set_value(requested_.line(), active ? 1 : 0) == 0) return {};
    return tl::unexpected(line_fault(text_, errno));
  }

 private:
  Requested requested_;
  std::string text_;
};

}  // namespace

tl::expected<ChipInfo, int> read_chip(const std::string& path) {
  const Chip chip(gpiod_chip_open(path.c_str()), gpiod_chip_close);
  if (!chip) return tl::unexpected(errno);
  ChipInfo info{.path = path, .label = text_of(gpiod_chip_label(chip.get()))};
  for (unsigned offset = 0; offset < gpiod_chip_num_lines(chip.get()); ++offset) {
    gpiod_line* line = gpiod_chip_get_line(chip.get(), offset);
    if (!line) return tl::unexpected(errno);
    info.lines.push_back({offset, text_of(gpiod_line_name(line)),
                          gpiod_line_direction(line) == GPIOD_LINE_DIRECTION_OUTPUT,
                          gpiod_line_is_used(line), text_of(gpiod_line_consumer(line))});
  }
  return info;
}

tl::expected<std::unique_ptr<DigitalInput>, int> request_input(const std::string& path,
                                                               unsigned offset,
                                                               const InputSettings& settings) {
  auto requested = Requested::make(path, offset, GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES,
                                   flags(settings.active_low, settings.bias));
  if (!requested) return tl::unexpected(requested.error());
  if (!never_wait(gpiod_line_event_get_fd(requested->line()))) return tl::unexpected(errno);
  return std::make_unique<Input>(std::move(*requested), settings.address.text());
}

tl::expected<std::unique_ptr<DigitalOutput>, int> request_output(const std::string& path,
                                                                 unsigned offset,
                                                                 const OutputSettings& settings) {
  auto requested = Requested::make(path, offset, GPIOD_LINE_REQUEST_DIRECTION_OUTPUT,
                                   flags(settings.active_low, settings.bias));
  if (!requested) return tl::unexpected(requested.error());
  return std::make_unique<Output>(std::move(*requested), settings.address.text());
}

}  // namespace orbwatch::hal::gpiod_calls
