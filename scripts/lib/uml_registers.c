/* Preloaded into user-mode Linux by scripts/with_vcan. Linux takes the extended registers of a traced process only in the full size
   that the processor has (PTRACE_SETREGSET, NT_X86_XSTATE). User-mode Linux 6.1 keeps those up to AVX-512 and fails at once on a
   processor with more, such as AMX. What it leaves out is in its initial state, which is all zeros. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <elf.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/uio.h>

typedef long (*Ptrace)(enum __ptrace_request, pid_t, void*, void*);

static char registers[64 * 1024];
static size_t full_size;

/* The size that Linux gives is the one that it takes. */
static void measure(Ptrace real, pid_t pid, void* type) {
  struct iovec all = {registers, sizeof registers};
  full_size = real(PTRACE_GETREGSET, pid, type, &all) == 0 ? all.iov_len : 0;
  memset(registers, 0, sizeof registers);
}

static long set_registers(Ptrace real, pid_t pid, void* type, struct iovec* part) {
  if (full_size == 0) measure(real, pid, type);
  if (part->iov_len >= full_size) return real(PTRACE_SETREGSET, pid, type, part);
  memcpy(registers, part->iov_base, part->iov_len);
  struct iovec all = {registers, full_size};
  return real(PTRACE_SETREGSET, pid, type, &all);
}

long ptrace(enum __ptrace_request request, ...) {
  static Ptrace real;
  if (!real) real = (Ptrace)dlsym(RTLD_NEXT, "ptrace");
  va_list arguments;
  va_start(arguments, request);
  const pid_t pid = va_arg(arguments, pid_t);
  void* const address = va_arg(arguments, void*);
  void* const data = va_arg(arguments, void*);
  va_end(arguments);
  if (request == PTRACE_SETREGSET && (intptr_t)address == NT_X86_XSTATE) return set_registers(real, pid, address, data);
  return real(request, pid, address, data);
}
