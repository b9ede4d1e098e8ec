// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <string>

#include "tests/app/update/fake_rauc.h"

/// Serves FakeRauc's bus in the folder that is named, for the page's tests. Each line of standard
/// input ends an installation: an empty one with success, another one with this error.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  orbwatch::app::update::tests::FakeRauc rauc(argv[1]);
  std::cout << rauc.address() << std::endl;
  for (std::string line; std::getline(std::cin, line);) rauc.finish(line);
  return 0;
}
