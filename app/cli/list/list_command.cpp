#include <iostream>

#include "app/cli/command.h"
#include "app/cli/list/list.h"
#include "app/cli/options/options.h"

namespace orbwatch::app {

Result<> list_command(const std::vector<std::string>& arguments) {
  bool json = false, help = false;
  const std::vector<Option> options{{"json", 0, "", "for programs", flag_option(json)},
                                    {"help", 'h', "", "this text", flag_option(help)}};
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (!rest->empty()) return fail("unexpected argument " + rest->front() + "; see --help");
  if (help) {
    std::cout << "Usage: orbwatch list [--json]\n\n"
                 "Shows the cameras that are connected, with their modes and controls, and the\n"
                 "GPIO chips with their lines.\n\n"
              << options_help(options);
    return {};
  }
  const hal::Inventory inventory = take_inventory();
  std::cout << (json ? list_json(inventory) : list_table(inventory));
  return {};
}

}  // namespace orbwatch::app
