// SPDX-License-Identifier: Apache-2.0
/* A TCG plugin that counts the instructions of a pipeline's frame set, and of its stages:
 *
 *   qemu-aarch64 -plugin ./libcount_stages.so,out=FILE program ...
 *
 * writes one line to FILE: the instructions of all threads in the last whole frame set, then those
 * of the pipeline's thread before each reading of its own clock in that set, by which the product
 * measures its stages. That thread marks the beginning of each set by sched_yield with arguments
 * that the kernel ignores (see count_reference.cpp). */
#include <stdbool.h>

#include "tests/bench/plugin_output.h"
#include "tests/bench/qemu_plugin.h"

/* System calls on aarch64, and the clock of the calling thread. */
enum { kClockGettime = 113, kSchedYield = 124, kThreadClock = 3 };
enum { kFrameSetBegins = 0x5E7, kMaxThreads = 256, kMaxStretches = 64 };

struct frame_set {
  uint64_t instructions;
  uint64_t stretches[kMaxStretches];
  int count;
};

static const char* out_path;
static uint64_t executed, executed_by[kMaxThreads];
static struct frame_set present, whole;
static bool is_marked;
static unsigned int pipeline;
static uint64_t executed_before, executed_by_pipeline_before;
static bool too_much;

static void on_block_executed(unsigned int vcpu_index, void* instructions) {
  __atomic_fetch_add(&executed, (uintptr_t)instructions, __ATOMIC_RELAXED);
  if (vcpu_index < kMaxThreads) {
    executed_by[vcpu_index] += (uintptr_t)instructions;
  } else {
    too_much = true;
  }
}

static void on_block_translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  const uintptr_t instructions = qemu_plugin_tb_n_insns(tb);
  qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block_executed, QEMU_PLUGIN_CB_NO_REGS,
                                       (void*)instructions);
}

static void begin_set(unsigned int vcpu_index) {
  const uint64_t now = __atomic_load_n(&executed, __ATOMIC_RELAXED);
  if (is_marked) {
    present.instructions = now - executed_before;
    whole = present;
  }
  is_marked = true;
  pipeline = vcpu_index;
  executed_before = now;
  executed_by_pipeline_before = executed_by[vcpu_index];
  present.count = 0;
}

static void end_stretch(void) {
  if (present.count == kMaxStretches) {
    too_much = true;
    return;
  }
  const uint64_t now = executed_by[pipeline];
  present.stretches[present.count++] = now - executed_by_pipeline_before;
  executed_by_pipeline_before = now;
}

static void on_system_call(qemu_plugin_id_t id, unsigned int vcpu_index, int64_t number,
                           uint64_t a1, uint64_t a2, uint64_t a3, uint64_t a4, uint64_t a5,
                           uint64_t a6, uint64_t a7, uint64_t a8) {
  (void)id, (void)a2, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (vcpu_index >= kMaxThreads) return;
  if (number == kSchedYield && a1 == kFrameSetBegins) begin_set(vcpu_index);
  if (number == kClockGettime && a1 == kThreadClock && is_marked && vcpu_index == pipeline) {
    end_stretch();
  }
}

static void on_program_exit(qemu_plugin_id_t id, void* userdata) {
  (void)id;
  (void)userdata;
  if (too_much) {
    fprintf(stderr, "count_stages: more threads or stages than there is room for\n");
  } else {
    write_numbers(out_path, whole.instructions, whole.stretches, whole.count);
  }
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
  (void)info;
  out_path = output_path(argc, argv);
  if (!out_path) return 1;
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_block_translated);
  qemu_plugin_register_vcpu_syscall_cb(id, on_system_call);
  qemu_plugin_register_atexit_cb(id, on_program_exit, NULL);
  return 0;
}
