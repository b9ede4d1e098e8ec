// SPDX-License-Identifier: Apache-2.0
/* A TCG plugin that counts the instructions a program executes under qemu-user:
 *
 *   qemu-aarch64 -plugin ./libcount_instructions.so,out=FILE program ...
 *
 * writes their number, one decimal line, to FILE when the program exits: the sum of all threads,
 * the loader included. The cost of one call is the difference between two runs that differ in that
 * call only. */
#include "tests/bench/plugin_output.h"
#include "tests/bench/qemu_plugin.h"

static const char* out_path;
static uint64_t executed;

static void on_block_executed(unsigned int vcpu_index, void* instructions) {
  (void)vcpu_index;
  __atomic_fetch_add(&executed, (uintptr_t)instructions, __ATOMIC_RELAXED);
}

static void on_block_translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  const uintptr_t instructions = qemu_plugin_tb_n_insns(tb);
  qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block_executed, QEMU_PLUGIN_CB_NO_REGS,
                                       (void*)instructions);
}

static void on_program_exit(qemu_plugin_id_t id, void* userdata) {
  (void)id;
  (void)userdata;
  write_number(out_path, executed);
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
  (void)info;
  out_path = output_path(argc, argv);
  if (!out_path) return 1;
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_block_translated);
  qemu_plugin_register_atexit_cb(id, on_program_exit, NULL);
  return 0;
}
