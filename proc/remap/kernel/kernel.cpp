// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/kernel/kernel.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

// The list of add_kernel() in CMakeLists.txt: ORBWATCH_KERNEL(name, runs_here) for the processor
// that is compiled for, ORBWATCH_FOREIGN_KERNEL(name) for others.
#define ORBWATCH_KERNEL(name, runs_here) \
  namespace orbwatch::remap::name {      \
  extern const Kernel kKernel;           \
  }
#define ORBWATCH_FOREIGN_KERNEL(name)
#include "proc/remap/kernel/kernel_list.inc"
#undef ORBWATCH_KERNEL
#undef ORBWATCH_FOREIGN_KERNEL

namespace orbwatch::remap {
namespace {

struct Candidate {
  std::string_view name;
  const Kernel* kernel;  ///< null where this machine cannot run it
};

const auto& candidates() {
#define ORBWATCH_KERNEL(name, runs_here) Candidate{#name, (runs_here) ? &name::kKernel : nullptr},
#define ORBWATCH_FOREIGN_KERNEL(name) Candidate{#name, nullptr},
  static const std::array kCandidates{
#include "proc/remap/kernel/kernel_list.inc"
  };
#undef ORBWATCH_KERNEL
#undef ORBWATCH_FOREIGN_KERNEL
  return kCandidates;
}

/// A list such as "scalar, avx2".
template <class Predicate>
std::string names_where(const Predicate& predicate) {
  std::string list;
  for (const Candidate& candidate : candidates()) {
    if (!predicate(candidate)) continue;
    if (!list.empty()) list += ", ";
    list += candidate.name;
  }
  return list;
}

}  // namespace

std::span<const Kernel* const> kernels() {
  static const std::vector<const Kernel*> kRunnable = [] {
    std::vector<const Kernel*> runnable;
    for (const Candidate& candidate : candidates()) {
      if (candidate.kernel) runnable.push_back(candidate.kernel);
    }
    return runnable;
  }();
  return kRunnable;
}

const Kernel& scalar_kernel() { return scalar::kKernel; }

Result<const Kernel*> find_kernel(std::string_view name) {
  const auto found = std::ranges::find(candidates(), name, &Candidate::name);
  if (found == candidates().end()) {
    return fail("remap kernel '" + std::string(name) + "' is none of " +
                names_where([](const Candidate&) { return true; }));
  }
  if (!found->kernel) {
    return fail("this machine cannot run the remap kernel '" + std::string(name) + "', only " +
                names_where([](const Candidate& c) { return c.kernel != nullptr; }));
  }
  return found->kernel;
}

Result<const Kernel*> requested_kernel() {
  const char* const name = std::getenv("ORBWATCH_ISA");
  if (!name) return kernels().back();
  const auto found = find_kernel(name);
  return found ? found : fail("ORBWATCH_ISA: " + found.error().message);
}

const Kernel& default_kernel() {
  static const Kernel& kChosen = *requested_kernel().value_or(kernels().back());
  return kChosen;
}

}  // namespace orbwatch::remap
