// A library for LD_PRELOAD: the N-th call of a kind fails once, or fails from there on.
//
//   LEKALO_FAULT=KIND:N:ERRNO[+]   KIND is memory (malloc, calloc, realloc, and so operator new) or files
//   (open,
//                                  read, write, fstat, link, rename, fchmod, fchown, fsync, close, what
//                                  SQLite calls besides, and stdio's writing to stdout); ERRNO is a number; +
//                                  stands for "and every later one"
//   LEKALO_FAULT_REPORT=PATH       gets the number of calls of either kind when the program ends, and the
//   name of
//                                  the first that failed
//
// Calls count from the first line of main to its last: what the loader does before is not ours to mend, and
// nobody could be told. unlink is never refused, for nothing could then clean up. A close that fails has
// closed, as on Linux.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr unsigned kMostSeconds = 60;  ///< a program that hangs is ended by SIGALRM

enum Kind { kMemory, kFiles, kKinds };

std::atomic<bool> armed{false};
std::atomic<long> seen[kKinds];
long wanted = 0;  ///< the number of the call that fails; 0 for none
Kind wanted_kind = kMemory;
int wanted_errno = 0;
bool wanted_later_too = false;
std::atomic<const char*> first_refused{"none"};

/// Counts a call; true, with errno, for one that is to fail.
bool fails(Kind kind, const char* name) {
  if (!armed.load(std::memory_order_relaxed)) return false;
  const long number = ++seen[kind];
  if (wanted == 0 || kind != wanted_kind) return false;
  if (number < wanted || (number > wanted && !wanted_later_too)) return false;
  if (number == wanted) first_refused = name;
  errno = wanted_errno;
  return true;
}

template <class Function>
Function* next_of(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void read_wish() {
  const char* text = std::getenv("LEKALO_FAULT");
  if (text == nullptr) return;
  char kind[16] = {}, later = 0;
  if (std::sscanf(text, "%15[a-z]:%ld:%d%c", kind, &wanted, &wanted_errno, &later) < 3) _exit(127);
  wanted_kind = std::strcmp(kind, "memory") == 0 ? kMemory : kFiles;
  wanted_later_too = later == '+';
}

void report() {
  const char* path = std::getenv("LEKALO_FAULT_REPORT");
  if (path == nullptr) return;
  char text[120];
  const int length = std::snprintf(text, sizeof text, "%ld %ld %s\n", seen[kMemory].load(),
                                   seen[kFiles].load(), first_refused.load());
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || syscall(SYS_write, file, text, length) != length) _exit(127);
  syscall(SYS_close, file);
}

using Main = int(int, char**, char**);
Main* program = nullptr;

int run_armed(int count, char** words, char** environment) {
  read_wish();
  alarm(kMostSeconds);
  armed = true;
  const int status = program(count, words, environment);
  armed = false;
  report();
  return status;
}

int open_file(const char* path, int flags, mode_t mode) {
  return fails(kFiles, "open") ? -1 : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

mode_t mode_of(int flags, va_list more) { return (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0; }

}  // namespace

extern "C" {

// The C library's own names of these need no look-up, which would allocate.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);

void* malloc(std::size_t size) { return fails(kMemory, "malloc") ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) {
  return fails(kMemory, "calloc") ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  return fails(kMemory, "realloc") ? nullptr : __libc_realloc(block, size);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file(path, flags, mode);
}

ssize_t read(int file, void* bytes, std::size_t count) {
  return fails(kFiles, "read") ? -1 : syscall(SYS_read, file, bytes, count);
}
ssize_t write(int file, const void* bytes, std::size_t count) {
  return fails(kFiles, "write") ? -1 : syscall(SYS_write, file, bytes, count);
}
ssize_t pread64(int file, void* bytes, std::size_t count, off64_t at) {
  return fails(kFiles, "pread64") ? -1 : syscall(SYS_pread64, file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t at) {
  return fails(kFiles, "pwrite64") ? -1 : syscall(SYS_pwrite64, file, bytes, count, at);
}
int ftruncate64(int file, off64_t size) noexcept {
  return fails(kFiles, "ftruncate64") ? -1 : static_cast<int>(syscall(SYS_ftruncate, file, size));
}
int fsync(int file) { return fails(kFiles, "fsync") ? -1 : static_cast<int>(syscall(SYS_fsync, file)); }
int fdatasync(int file) {
  return fails(kFiles, "fdatasync") ? -1 : static_cast<int>(syscall(SYS_fdatasync, file));
}
int fchmod(int file, mode_t mode) noexcept {
  return fails(kFiles, "fchmod") ? -1 : static_cast<int>(syscall(SYS_fchmod, file, mode));
}
int fchown(int file, uid_t user, gid_t group) noexcept {
  return fails(kFiles, "fchown") ? -1 : static_cast<int>(syscall(SYS_fchown, file, user, group));
}
int fstat(int file, struct stat* status) noexcept {
  return fails(kFiles, "fstat") ? -1 : static_cast<int>(syscall(SYS_fstat, file, status));
}
int link(const char* from, const char* to) noexcept {
  return fails(kFiles, "link") ? -1 : static_cast<int>(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int rename(const char* from, const char* to) noexcept {
  return fails(kFiles, "rename") ? -1
                                 : static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int close(int file) {
  const bool refused = fails(kFiles, "close");
  const int why = errno, done = static_cast<int>(syscall(SYS_close, file));
  if (!refused) return done;
  errno = why;
  return -1;
}

std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, FILE* file) {
  static auto* const real = next_of<std::size_t(const void*, std::size_t, std::size_t, FILE*)>("fwrite");
  return file == stdout && fails(kFiles, "fwrite") ? 0 : real(bytes, size, count, file);
}
int fflush(FILE* file) {
  static auto* const real = next_of<int(FILE*)>("fflush");
  return file == stdout && fails(kFiles, "fflush") ? EOF : real(file);
}

int __libc_start_main(Main* main, int count, char** words, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
  program = main;
  using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
  return next_of<Start>("__libc_start_main")(run_armed, count, words, init, fini, loader_fini, stack_end);
}

}  // extern "C"
