// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "app/cli/doctor/checks.h"
#include "hal/lines/find_line.h"
#include "hal/module/load_module.h"

/// Checks of memory for cameras, cameras, digital lines.
namespace orbwatch::app::cli::doctor {
namespace {

bool needs_heaps(const files::Configuration& site) {
  return std::ranges::any_of(site.cameras, [](const files::CameraSettings& camera) {
    return files::facts_of(camera.back_end).has_board_sensors;
  });
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string join_group(const char* group) {
  return std::string("sudo usermod -aG ") + group + " $USER, then log in again";
}

/// Remedy for devices that udev's rules were not applied to, or whose group the user is not in.
std::string apply_rules(const std::string& subsystem, const char* group) {
  return "sudo udevadm trigger --action=change --subsystem-match=" + subsystem + " && " +
         join_group(group);
}

/// Remedy for a camera that the board does not detect by itself.
std::string missing_camera_remedy(const CameraFacts& camera, const BoardFacts& board) {
  const BoardCamera* const known =
      board.known ? find_camera(*board.known, camera.address) : nullptr;
  if (known == nullptr || board.known->firmware_file.empty()) {
    return "connect it; orbwatch list shows what there is";
  }
  std::string lines;
  const auto add = [&lines](const std::string& line) { lines += " '" + line + "'"; };
  std::ranges::for_each(board.known->firmware_lines, add);
  add(known->overlay);
  return "printf '%s\\n'" + lines + " | sudo tee -a " + board.known->firmware_file +
         " && sudo reboot";
}

Diagnosis camera_diagnosis(const CameraFacts& camera, const BoardFacts& board) {
  const std::string who = camera.name + " (" + camera.address + ")";
  switch (camera.presence) {
    case Presence::There:
      return ok(who + ": is there");
    case Presence::Simulated:
      return ok(camera.name + ": is made up by orbwatchd itself");
    case Presence::Closed:
      return fault(who + ": " + camera.error, join_group("video"));
    case Presence::NoModule:
      return fault(who + ": " + camera.error, hal::install_command(camera.module));
    case Presence::Missing:
      break;
  }
  const std::string others =
      camera.others.empty() ? "there is no camera" : "there are: " + listed(camera.others);
  return fault(who + ": " + camera.error + "; " + others, missing_camera_remedy(camera, board));
}

/// Electrical facts about a line from the board's file, as text.
std::string electrical(const BoardLines* lines) {
  if (lines == nullptr) return "";
  std::string text = std::to_string(lines->volt);
  text.resize(text.find('.') + 2);
  text = ", " + text + " V at most";
  if (lines->pull == Pull::Up || lines->pull == Pull::Down) {
    text += ", pulled " + std::string(word_for(kPulls, lines->pull)) + " from power-on";
  }
  return text;
}

/// True if the board's resistor makes an output active that no program drives.
bool rests_active(const LineSettings& line, const BoardLines* lines) {
  if (is_input(line.use) || lines == nullptr || line.wire.bias != hal::LineBias::AsIs) return false;
  return lines->pull == (line.wire.active_low ? Pull::Down : Pull::Up);
}

/// Warning about a configured camera of this board whose trigger input has a voltage other than the
/// line's.
std::string trigger_hint(const LineSettings& line, const BoardLines* lines, const Facts& facts) {
  if (line.use != LineUse::TriggerOut || lines == nullptr) return "";
  for (const CameraFacts& camera : facts.cameras) {
    const BoardCamera* const known = find_camera(*facts.board.known, camera.address);
    if (known == nullptr || known->trigger_volt <= 0 || known->trigger_volt >= lines->volt)
      continue;
    std::string volt = std::to_string(known->trigger_volt);
    volt.resize(volt.find('.') + 2);
    return "; the trigger input of " + camera.name + " bears " + volt + " V only: divide it down";
  }
  return "";
}

Diagnosis line_diagnosis(const LineSettings& line, const Facts& facts) {
  const std::string who = line.name + ": ";
  const auto found = hal::find_line(facts.chips, line.wire.address);
  if (!found) {
    const bool closed = std::ranges::any_of(
        facts.chips, [](const hal::ChipInfo& chip) { return !chip.error.empty(); });
    return fault(
        who + found.error().message,
        closed ? apply_rules("gpio", "gpio") : "orbwatch list shows lines; mend line_name or chip");
  }
  const std::string place = line.wire.address.text();
  const hal::LineInfo& info = *found->line;
  if (info.is_used && info.consumer == hal::kLineConsumer) {
    return ok(who + place + " is held by orbwatchd");
  }
  if (info.is_used) {
    const std::string by = info.consumer.empty() ? "a driver of the kernel" : info.consumer;
    return fault(who + place + " is used by " + by,
                 "choose another line, or end what uses it: gpioinfo shows it");
  }
  const BoardLines* const lines =
      facts.board.known ? find_lines(*facts.board.known, info.name) : nullptr;
  if (rests_active(line, lines)) {
    return warning(who + place + electrical(lines) + ": active when nobody drives it",
                   "active_low = " + std::string(line.wire.active_low ? "false" : "true") +
                       " and matching wiring, or a stronger resistor the other way");
  }
  return ok(who + place + electrical(lines) + trigger_hint(line, lines, facts));
}

}  // namespace

Diagnoses check_heaps(const Facts& facts) {
  if (!facts.site || !needs_heaps(*facts.site)) return {};
  if (facts.heaps.empty()) {
    return {fault("/dev/dma_heap is not there, which libcamera needs",
                  "sudo apt install linux-image-$(dpkg --print-architecture), or the kernel of the "
                  "board's maker")};
  }
  Diagnoses found;
  std::string usable;
  for (const Heap& heap : facts.heaps) {
    if (heap.error.empty()) {
      usable += (usable.empty() ? "" : ", ") + heap.path;
    } else {
      found.push_back(fault(heap.path + ": " + heap.error, apply_rules("dma_heap", "video")));
    }
  }
  if (found.empty()) found.push_back(ok(usable));
  return found;
}

Diagnoses check_cameras(const Facts& facts) {
  Diagnoses found;
  for (const CameraFacts& camera : facts.cameras) {
    found.push_back(camera_diagnosis(camera, facts.board));
  }
  return found;
}

Diagnoses check_lines(const Facts& facts) {
  Diagnoses found;
  if (!facts.site) return found;
  for (const LineSettings& line : facts.site->lines) {
    if (line.back_end == LineKind::Gpio) found.push_back(line_diagnosis(line, facts));
  }
  return found;
}

}  // namespace orbwatch::app::cli::doctor
