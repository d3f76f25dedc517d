// Installs handlers for exceptions of Windows and for abort().
#include "crash_report.h"

#include <windows.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>

#include "crash_line.h"

namespace evalcts {
namespace {

constexpr int kMostFrames = 8;              // number of reported frames
constexpr int kCrashed = 139, kHung = 124;  // exit codes
constexpr ULONG kStackOfHandler = 64 * 1024;

const EventFile* events_of_process = nullptr;

HMODULE module_at(DWORD64 address) {
  HMODULE module = nullptr;
  GetModuleHandleExA(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                     reinterpret_cast<LPCSTR>(address), &module);
  return module;
}

void add_frame(CrashLine& line, DWORD64 address) {
  HMODULE const module = module_at(address);
  std::array<char, MAX_PATH> path{};
  const std::string_view file(path.data(), module ? GetModuleFileNameA(module, path.data(), path.size()) : 0);
  line.add_frame(file.substr(file.find_last_of('\\') + 1), "", address - reinterpret_cast<DWORD64>(module));
}

// Adds the frames up to the first one of this program behind those of the library.
void add_frames(CrashLine& line, CONTEXT context) {
  HMODULE const own = GetModuleHandleA(nullptr);
  for (int i = 0; i < kMostFrames && context.Rip; ++i) {
    if (i > 0 && module_at(context.Rip) == own) return;
    add_frame(line, context.Rip);
    DWORD64 base = 0;
    PRUNTIME_FUNCTION const function = RtlLookupFunctionEntry(context.Rip, &base, nullptr);
    if (!function) {  // a function without a frame of its own
      if (module_at(context.Rip) == nullptr && i > 0) return;
      context.Rip = *reinterpret_cast<DWORD64*>(context.Rsp);
      context.Rsp += sizeof(DWORD64);
      continue;
    }
    void* data = nullptr;
    DWORD64 frame = 0;
    RtlVirtualUnwind(UNW_FLAG_NHANDLER, base, context.Rip, function, &context, &data, &frame, nullptr);
  }
}

[[noreturn]] void end(CrashLine& line, int code) {
  events_of_process->write_in_handler(line.finish());
  TerminateProcess(GetCurrentProcess(), static_cast<UINT>(code));
  std::abort();
}

LONG WINAPI handle(EXCEPTION_POINTERS* exception) {
  CrashLine line;
  add_frames(line, *exception->ContextRecord);
  end(line, kCrashed);
}

void handle_abort(int) {
  CrashLine line;
  CONTEXT here{};
  RtlCaptureContext(&here);
  add_frames(line, here);
  end(line, kCrashed);
}

}  // namespace

void report_crashes(const EventFile& events) {
  events_of_process = &events;
  CrashLine::prepare();
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);  // no windows that wait for an answer
  ULONG stack = kStackOfHandler;
  SetThreadStackGuarantee(&stack);
  SetUnhandledExceptionFilter(handle);
  std::signal(SIGABRT, handle_abort);
}

void end_hanging_job() {
  CrashLine line;
  end(line, kHung);
}

}  // namespace evalcts
