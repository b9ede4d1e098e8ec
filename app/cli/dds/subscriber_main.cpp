// SPDX-License-Identifier: Apache-2.0
#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/program.h"

/// `orbwatch subscribe` as a program of its own, for the demo: built without the other commands.
int main(int argc, char** argv) {
  orbwatch::app::cli::Arguments arguments{{"subscribe"}};
  arguments.words.insert(arguments.words.end(), argv + 1, argv + argc);
  return orbwatch::app::cli::run_program("orbwatch_subscriber", arguments,
                                         orbwatch::app::cli::subscribe_command);
}
