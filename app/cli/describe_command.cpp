#include <iostream>

#include "app/cli/command.h"
#include "app/cli/options.h"
#include "app/config/configuration.h"
#include "app/modbus/register_manual.h"

namespace orbwatch::app {

Result<> describe_command(const std::vector<std::string>& arguments) {
  std::string format = "markdown";
  bool help = false;
  const std::vector<Option> options{
      {"format", 0, "csv|markdown", "of the registers (default markdown)",
       [&](const std::string& value) -> Result<> {
         format = value;
         if (value == "csv" || value == "markdown") return {};
         return fail("--format is \"" + value + "\"; use csv or markdown");
       }},
      {"help", 'h', "", "this text", [&](const std::string&) -> Result<> {
         help = true;
         return {};
       }}};
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (help) {
    std::cout << "Usage: orbwatch describe config | registers [options]\n\n"
                 "Prints the manual of the configuration file or of the Modbus registers.\n\n"
              << options_help(options);
  } else if (*rest == std::vector<std::string>{"config"}) {
    std::cout << configuration_manual();
  } else if (*rest == std::vector<std::string>{"registers"}) {
    std::cout << (format == "csv" ? registers_csv() : registers_markdown());
  } else {
    return fail("say what to describe: config or registers; see --help");
  }
  return {};
}

}  // namespace orbwatch::app
