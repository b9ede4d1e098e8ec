// SPDX-License-Identifier: Apache-2.0
/* A TCG plugin that counts the memory that a program touches in one stretch of its work:
 *
 *   qemu-aarch64 -plugin ./libcount_bytes.so,out=FILE program ...
 *
 * writes 64 times the number of different cache lines read or written there to FILE. The
 * single-threaded program calls sched_yield with arguments that the kernel ignores: an address and
 * a size exclude that memory, two zeros begin and end the stretch (see counted_run.h). */
#include <stdbool.h>

#include "tests/bench/plugin_output.h"
#include "tests/bench/qemu_plugin.h"

enum { kSchedYield = 124 /* on aarch64 */, kLineBits = 6, kPageBits = 12 };
enum { kPageSlots = 1 << 20, kMaxLeftOut = 16 };

/* The touched lines of a page, one bit each; a free slot has none. Slots are found by hashing. */
struct page {
  uint64_t number;
  uint64_t lines;
};
static struct page pages[kPageSlots];

static struct range {
  uint64_t first_line;
  uint64_t end_line;
} left_out[kMaxLeftOut];
static int left_out_count;

static const char* out_path;
static bool in_stretch;
static bool too_much;

static void touch(uint64_t line) {
  const uint64_t number = line >> (kPageBits - kLineBits);
  const uint64_t bit = UINT64_C(1) << (line & 63);
  uint64_t slot = number * UINT64_C(0x9E3779B97F4A7C15) >> 44;
  for (int tries = 0; tries < kPageSlots; ++tries, slot = (slot + 1) % kPageSlots) {
    struct page* page = &pages[slot];
    if (page->lines == 0) page->number = number;
    if (page->number != number) continue;
    page->lines |= bit;
    return;
  }
  too_much = true;
}

static void on_access(unsigned int vcpu_index, qemu_plugin_meminfo_t info, uint64_t address,
                      void* userdata) {
  (void)vcpu_index;
  (void)userdata;
  if (!in_stretch) return;
  const uint64_t last = address + (UINT64_C(1) << qemu_plugin_mem_size_shift(info)) - 1;
  touch(address >> kLineBits);
  if (last >> kLineBits != address >> kLineBits) touch(last >> kLineBits);
}

static void on_block_translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
  (void)id;
  const size_t count = qemu_plugin_tb_n_insns(tb);
  for (size_t i = 0; i < count; ++i) {
    qemu_plugin_register_vcpu_mem_cb(qemu_plugin_tb_get_insn(tb, i), on_access,
                                     QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW, NULL);
  }
}

static bool is_left_out(uint64_t line) {
  for (int i = 0; i < left_out_count; ++i) {
    if (line >= left_out[i].first_line && line < left_out[i].end_line) return true;
  }
  return false;
}

static uint64_t touched_lines(void) {
  uint64_t count = 0;
  for (int slot = 0; slot < kPageSlots; ++slot) {
    const uint64_t first = pages[slot].number << (kPageBits - kLineBits);
    for (int i = 0; i < 64; ++i) {
      if (pages[slot].lines >> i & 1) count += !is_left_out(first + (uint64_t)i);
    }
  }
  return count;
}

static void on_system_call(qemu_plugin_id_t id, unsigned int vcpu_index, int64_t number,
                           uint64_t address, uint64_t size, uint64_t a3, uint64_t a4, uint64_t a5,
                           uint64_t a6, uint64_t a7, uint64_t a8) {
  (void)id, (void)vcpu_index, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (number != kSchedYield) return;
  if (size == 0) {
    in_stretch = !in_stretch;
  } else if (left_out_count < kMaxLeftOut) {
    const uint64_t end = address + size + (1 << kLineBits) - 1;
    left_out[left_out_count++] = (struct range){address >> kLineBits, end >> kLineBits};
  } else {
    too_much = true;
  }
}

static void on_program_exit(qemu_plugin_id_t id, void* userdata) {
  (void)id;
  (void)userdata;
  if (too_much) {
    fprintf(stderr, "count_bytes: more memory, or more of it left out, than there is room for\n");
  } else {
    write_number(out_path, touched_lines() << kLineBits);
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
