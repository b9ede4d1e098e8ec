// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/find_line.h"

#include <grp.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace orbwatch::hal {
namespace {

std::string system_text(int code) { return std::generic_category().message(code); }

bool is_at(const ChipInfo& chip, const LineInfo& line, const LineAddress& address) {
  return address.name.empty() ? chip.label == address.chip && line.offset == address.offset
                              : line.name == address.name;
}

/// Lists the existing chips and lines, for a line that was not found.
std::string what_there_is(const std::vector<ChipInfo>& chips) {
  std::string names, labels, closed;
  const auto append = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  for (const ChipInfo& chip : chips) {
    if (!chip.error.empty()) {
      append(closed, chip.error);
      continue;
    }
    append(labels, chip.label + " (" + std::to_string(chip.lines.size()) + " lines)");
    for (const LineInfo& line : chip.lines) {
      if (!line.name.empty()) append(names, line.name);
    }
  }
  std::string text = labels.empty() ? "there is no chip" : "chips: " + labels;
  text += names.empty() ? "; no line has a name" : "; named lines: " + names;
  return closed.empty() ? text : text + "; " + closed;
}

std::string group_name(gid_t group) {
  std::array<char, 4096> buffer{};
  struct group entry {};
  struct group* found = nullptr;
  if (::getgrgid_r(group, &entry, buffer.data(), buffer.size(), &found) != 0 || !found) {
    return std::to_string(group);
  }
  return found->gr_name;
}

}  // namespace

Result<FoundLine> find_line(const std::vector<ChipInfo>& chips, const LineAddress& address) {
  FoundLine found;
  for (const ChipInfo& chip : chips) {
    for (const LineInfo& line : chip.lines) {
      if (!is_at(chip, line, address)) continue;
      if (found.line) {
        return fail("line " + address.text() + ": is there twice, on " + found.chip->path +
                    " and " + chip.path + "; address it so that it is one");
      }
      found = {&chip, &line};
    }
  }
  if (found.line) return found;
  return fail("line " + address.text() + ": there is none; " + what_there_is(chips));
}

std::string open_error(const FoundLine& found, const LineAddress& address, int code) {
  const std::string line = "line " + address.text() + ": ";
  switch (code) {
    case EBUSY:
      return line + "is used by " +
             (found.line->consumer.empty() ? "a driver of the kernel"
                                           : "\"" + found.line->consumer + "\"");
    case EACCES:
    case EPERM:
      return line + chip_error(found.chip->path, code);
    case EINVAL:
    case ENOTSUP:
    case 524:  // the kernel's own ENOTSUPP, which has no name in user space
      return line + "its chip " + found.chip->label +
             " does not support these settings; bias needs a chip with resistors, an input one "
             "with "
             "interrupts";
    default:
      return line + system_text(code);
  }
}

std::string chip_error(const std::string& path, int code) {
  struct stat node {};
  if ((code != EACCES && code != EPERM) || ::stat(path.c_str(), &node) != 0) {
    return path + ": " + system_text(code);
  }
  return path + ": no permission; it is for members of the group " + group_name(node.st_gid);
}

}  // namespace orbwatch::hal
