#include <array>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

#include "app/cli/command.h"
#include "app/version.h"

namespace orbwatch::app {
namespace {

struct Named {
  std::string_view name;
  std::string_view text;
  CommandFunction call;
};

constexpr std::array kCommandTable{
    Named{"project", "turn pictures of a mirror ball into an undistorted view", project_command},
    Named{"subscribe", "read views and process state of a running orbwatchd over DDS",
          subscribe_command},
    Named{"state", "show the process state of a running orbwatchd", state_command},
    Named{"command", "send a command to a running orbwatchd", command_command},
    Named{"dds-keys", "make the keys of a secured DDS domain", dds_keys_command},
    Named{"list", "show the cameras and GPIO lines that are connected", list_command},
    Named{"describe", "print manuals, and what follows from a rig or a view", describe_command},
};

void print_help() {
  std::cout << "Usage: orbwatch COMMAND [options]\n\n"
               "Tools around mirror balls and the orbwatchd service.\n\n";
  for (const Named& command : kCommandTable) {
    std::printf("  %-12s%s\n", command.name.data(), command.text.data());
  }
  std::cout << "\n`orbwatch COMMAND --help` explains a command; --version names the libraries.\n";
}

Result<> dispatch(const std::vector<std::string>& arguments) {
  const std::string name = arguments.empty() ? "" : arguments.front();
  if (name == "--help" || name == "-h") {
    print_help();
    return {};
  }
  if (name == "--version") {
    std::cout << version_text("orbwatch");
    return {};
  }
  for (const Named& command : kCommandTable) {
    if (command.name == name) return command.call(arguments);
  }
  return fail(name.empty() ? "say what to do; see --help"
                           : "there is no command " + name + "; see --help");
}

}  // namespace
}  // namespace orbwatch::app

int main(int argc, char** argv) try {
  const auto result = orbwatch::app::dispatch({argv + 1, argv + argc});
  if (result) return 0;
  std::fprintf(stderr, "orbwatch: %s\n", result.error().message.c_str());
  return 1;
} catch (const std::bad_alloc&) {
  std::fputs("orbwatch: not enough memory for pictures of this size\n", stderr);
  return 1;
}
