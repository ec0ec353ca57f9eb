// A plugin of QEMU (TCG plugin API, version 1): instructions between a function's entry and its return, and the lowest
// stack address that was written. QEMU's package has no header for it; what is used is declared here, by its manual.
//
// arguments: out=FILE, low=ADDRESS, high=ADDRESS (the stack), stage=NAME;ENTRY;RETURN;RETURN... (addresses behind the
// calls of it), times as many as there are stages.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <deque>
#include <set>
#include <string>
#include <vector>

extern "C" {
using PluginId = std::uint64_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
void qemu_plugin_register_vcpu_tb_trans_cb(PluginId, void (*)(PluginId, qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_cb(qemu_plugin_tb*, void (*)(unsigned, void*), int, void*);
void qemu_plugin_register_vcpu_mem_cb(qemu_plugin_insn*, void (*)(unsigned, std::uint32_t, std::uint64_t, void*), int,
                                      int, void*);
void qemu_plugin_register_atexit_cb(PluginId, void (*)(PluginId, void*), void*);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb*);
std::uint64_t qemu_plugin_tb_vaddr(const qemu_plugin_tb*);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb*, std::size_t);
[[gnu::visibility("default")]] extern int qemu_plugin_version;
int qemu_plugin_version = 1;
[[gnu::visibility("default")]] int qemu_plugin_install(PluginId id, const void* info, int argc, char** argv);
}

namespace {

constexpr int kNoRegisters = 0;
constexpr int kWrites = 2;

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
struct Block {
  std::uint64_t start;
  std::uint64_t instructions;
};

// Never destroyed: the emulator asks for the counts after the destructors of static objects.
std::vector<Stage>& stages = *new std::vector<Stage>;
std::deque<Block>& blocks = *new std::deque<Block>;  // keeps their addresses
std::string& out = *new std::string;
std::uint64_t instructions = 0;
std::uint64_t stack_low = 0;
std::uint64_t stack_high = 0;
std::uint64_t lowest = ~0ULL;

void on_block(unsigned /*cpu*/, void* data) {
  const Block& block = *static_cast<const Block*>(data);
  for (Stage& stage : stages) {
    if (block.start == stage.entry) {
      stage.inside = true;
      stage.entered_at = instructions;
    } else if (stage.inside && stage.returns.contains(block.start)) {
      const std::uint64_t took = instructions - stage.entered_at;
      stage.inside = false;
      ++stage.calls;
      stage.sum += took;
      if (took > stage.worst) stage.worst = took;
    }
  }
  instructions += block.instructions;
}

void on_write(unsigned /*cpu*/, std::uint32_t /*kind*/, std::uint64_t address, void* /*data*/) {
  if (address >= stack_low && address < stack_high && address < lowest) lowest = address;
}

void on_translation(PluginId /*id*/, qemu_plugin_tb* tb) {
  const std::size_t count = qemu_plugin_tb_n_insns(tb);
  blocks.push_back({qemu_plugin_tb_vaddr(tb), count});
  qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block, kNoRegisters, &blocks.back());
  for (std::size_t i = 0; i < count; ++i) {
    qemu_plugin_register_vcpu_mem_cb(qemu_plugin_tb_get_insn(tb, i), on_write, kNoRegisters, kWrites, nullptr);
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
