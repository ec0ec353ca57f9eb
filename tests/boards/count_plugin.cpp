// A plugin of QEMU (TCG plugin API, version 1): instructions between a function's entry and its return, and the lowest
// stack address that was written.
//
// arguments: out=FILE, low=ADDRESS, high=ADDRESS (the stack), stage=NAME;ENTRY;RETURN;RETURN... (addresses behind the
// calls of it), times as many as there are stages.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <set>
#include <string>
#include <vector>

#include "tests/boards/qemu_plugin.hpp"

int qemu_plugin_version = 1;

namespace {

using fencepost::test::kAddInline;
using fencepost::test::kNoRegisters;
using fencepost::test::kWrites;

struct Stage {
  std::string name;
  std::uint64_t entry = 0;
  std::set<std::uint64_t> returns;
  bool inside = false;
  std::uint64_t entered_at = 0;
  std::uint64_t calls = 0;
  std::uint64_t sum = 0;
  std::uint64_t worst = 0;
};

// Never destroyed: the emulator asks for the counts after the destructors of static objects.
std::vector<Stage>& stages = *new std::vector<Stage>;
std::set<std::uint64_t>& marks = *new std::set<std::uint64_t>;  // entries and returns
std::string& out = *new std::string;
std::uint64_t instructions = 0;
std::uint64_t stack_low = 0;
std::uint64_t stack_high = 0;
std::uint64_t lowest = ~0ULL;

void on_block(unsigned /*cpu*/, void* data) {
  const auto start = reinterpret_cast<std::uintptr_t>(data);
  for (Stage& stage : stages) {
    if (start == stage.entry) {
      stage.inside = true;
      stage.entered_at = instructions;
    } else if (stage.inside && stage.returns.contains(start)) {
      const std::uint64_t took = instructions - stage.entered_at;
      stage.inside = false;
      ++stage.calls;
      stage.sum += took;
      if (took > stage.worst) stage.worst = took;
    }
  }
}

void on_write(unsigned /*cpu*/, std::uint32_t /*kind*/, std::uint64_t address, void* /*data*/) {
  if (address >= stack_low && address < stack_high && address < lowest) lowest = address;
}

void on_translation(PluginId /*id*/, qemu_plugin_tb* tb) {
  const std::size_t count = qemu_plugin_tb_n_insns(tb);
  const std::uint64_t start = qemu_plugin_tb_vaddr(tb);
  if (marks.contains(start)) {
    qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block, kNoRegisters, reinterpret_cast<void*>(start));
  }
  for (std::size_t i = 0; i < count; ++i) {
    qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(tb, i);
    // One by one: a block is left where it reads a register of a device, and begun anew behind that.
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, kAddInline, &instructions, 1);
    qemu_plugin_register_vcpu_mem_cb(instruction, on_write, kNoRegisters, kWrites, nullptr);
  }
}

void on_exit(PluginId /*id*/, void* /*data*/) {
  std::FILE* file = std::fopen(out.c_str(), "w");
  if (file == nullptr) return;
  std::fprintf(file, "all 1 %llu 0\n", static_cast<unsigned long long>(instructions));
  std::fprintf(file, "stack 1 %llu 0\n",
               static_cast<unsigned long long>(lowest < stack_high ? stack_high - lowest : 0));
  for (const Stage& stage : stages) {
    std::fprintf(file, "%s %llu %llu %llu\n", stage.name.c_str(), static_cast<unsigned long long>(stage.calls),
                 static_cast<unsigned long long>(stage.sum), static_cast<unsigned long long>(stage.worst));
  }
  std::fclose(file);
}

void add_stage(const std::string& text) {
  Stage stage;
  std::size_t begin = 0;
  for (int field = 0; begin <= text.size(); ++field) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (field == 0) stage.name = word;
    if (field == 1) stage.entry = std::strtoull(word.c_str(), nullptr, 16);
    if (field > 1) stage.returns.insert(std::strtoull(word.c_str(), nullptr, 16));
    begin = end + 1;
  }
  marks.insert(stage.entry);
  marks.insert(stage.returns.begin(), stage.returns.end());
  stages.push_back(stage);
}

}  // namespace

int qemu_plugin_install(PluginId id, const void* /*info*/, int argc, char** argv) {
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string value = argument.substr(argument.find('=') + 1);
    if (argument.starts_with("out=")) out = value;
    if (argument.starts_with("low=")) stack_low = std::strtoull(value.c_str(), nullptr, 16);
    if (argument.starts_with("high=")) stack_high = std::strtoull(value.c_str(), nullptr, 16);
    if (argument.starts_with("stage=")) add_stage(value);
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, on_exit, nullptr);
  return 0;
}
