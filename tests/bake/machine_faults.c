// SPDX-License-Identifier: Apache-2.0
// Preloaded into the program: makes changes of files below THRONG_FAULT_UNDER fail, kills the process at one of them,
// lets the clock jump, or loses the device.
//   THRONG_FAULT=KIND:N:ERRNO  from the N-th (from 1) change of KIND on, all changes fail; KIND `any` counts all, and
//                              with `gone` reading fails, too
//   THRONG_FAULT=read:N:ERRNO  from the N-th piece that is read on, reading fails
//   THRONG_FAULT=kill:N        SIGKILL before the N-th change
//   THRONG_FAULT_COUNT=FILE    writes there, as it ends, how many changes there were
//   THRONG_CLOCK=1             every look at the date is an hour before or after the one before
//   THRONG_LOSE=N              the device is lost from the N-th question after it on
//   THRONG_LEAK=BYTES          so much memory is never given back, at each piece that is written
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static atomic_int changes, of_kind, failing, pieces_read, looks, questions;

static int below(const char* path) {
    const char* under = getenv("THRONG_FAULT_UNDER");
    return under && path && strncmp(path, under, strlen(under)) == 0;
}

static int isOurs(int file) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return 0;
    path[length] = 0;
    return below(path);
}

// What the fault is, if there is one.
static int fault(char wanted[32], int* at, int* reason) {
    const char* text = getenv("THRONG_FAULT");
    *reason = 0;
    return text && sscanf(text, "%31[^:]:%d:%d", wanted, at, reason) >= 2;
}

// Whether this change is to fail; errno says how.
static int fails(const char* kind, int ours) {
    char wanted[32];
    int at, reason;
    if (!ours) return 0;
    const int number = ++changes;
    if (!fault(wanted, &at, &reason)) return 0;
    if (strcmp(wanted, "kill") == 0) {
        if (number == at) kill(getpid(), SIGKILL);
        return 0;
    }
    const int counts = strcmp(wanted, "any") == 0 || strcmp(wanted, "gone") == 0 || strcmp(wanted, kind) == 0;
    if (counts && ++of_kind >= at) failing = 1;
    if (failing) errno = reason;
    return failing;
}

static int failsToRead(int file) {
    char wanted[32];
    int at, reason;
    if (!fault(wanted, &at, &reason) || !isOurs(file)) return 0;
    const int is_gone = strcmp(wanted, "gone") == 0 && failing;
    const int is_unreadable = strcmp(wanted, "read") == 0 && ++pieces_read >= at;
    if (is_gone || is_unreadable) errno = reason;
    return is_gone || is_unreadable;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void* bytes, size_t count) {
    if (fails("write", isOurs(file))) return -1;
    return REAL(write)(file, bytes, count);
}
static void leak(void) {
    const char* bytes = getenv("THRONG_LEAK");
    static void* volatile lost;
    if (bytes && (lost = malloc(atoi(bytes)))) memset(lost, 1, atoi(bytes));
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
    leak();
    if (fails("write", isOurs(file))) return -1;
    return REAL(pwrite)(file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
    if (fails("write", isOurs(file))) return -1;
    return REAL(pwrite64)(file, bytes, count, at);
}
ssize_t pread(int file, void* bytes, size_t count, off_t at) {
    return failsToRead(file) ? -1 : REAL(pread)(file, bytes, count, at);
}
ssize_t pread64(int file, void* bytes, size_t count, off64_t at) {
    return failsToRead(file) ? -1 : REAL(pread64)(file, bytes, count, at);
}
int fsync(int file) { return fails("sync", isOurs(file)) ? -1 : REAL(fsync)(file); }
int fdatasync(int file) { return fails("sync", isOurs(file)) ? -1 : REAL(fdatasync)(file); }
int ftruncate(int file, off_t size) { return fails("cut", isOurs(file)) ? -1 : REAL(ftruncate)(file, size); }
int mkdir(const char* path, mode_t mode) { return fails("mkdir", below(path)) ? -1 : REAL(mkdir)(path, mode); }
int rename(const char* from, const char* to) { return fails("rename", below(to)) ? -1 : REAL(rename)(from, to); }
int renameat2(int a, const char* from, int b, const char* to, unsigned flags) {
    return fails("rename", below(to)) ? -1 : REAL(renameat2)(a, from, b, to, flags);
}
int remove(const char* path) { return fails("remove", below(path)) ? -1 : REAL(remove)(path); }
int unlinkat(int folder, const char* path, int flags) {
    return fails("remove", below(path) || (path[0] != '/' && isOurs(folder))) ? -1
                                                                              : REAL(unlinkat)(folder, path, flags);
}
int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_CREAT) && fails("create", below(path)) ? -1 : REAL(open)(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_CREAT) && fails("create", below(path)) ? -1 : REAL(open64)(path, flags, mode);
}

static time_t jump(void) { return getenv("THRONG_CLOCK") ? (++looks % 2 ? 3600 : -3600) : 0; }
int clock_gettime(clockid_t clock, struct timespec* now) {
    const int result = REAL(clock_gettime)(clock, now);
    if (clock == CLOCK_REALTIME) now->tv_sec += jump();
    return result;
}
time_t time(time_t* now) {
    const time_t told = REAL(time)(NULL) + jump();
    if (now) *now = told;
    return told;
}

static unsigned lost(void) { return ++questions >= atoi(getenv("THRONG_LOSE")) ? 0x8254 : 0; }

__attribute__((constructor)) static void begin(void) {
    // libepoxy keeps the functions of OpenGL as pointers.
    unsigned (**status)(void) = dlsym(RTLD_DEFAULT, "epoxy_glGetGraphicsResetStatus");
    if (getenv("THRONG_LOSE") && status) *status = lost;
}

__attribute__((destructor)) static void end(void) {
    const char* path = getenv("THRONG_FAULT_COUNT");
    FILE* file = path ? fopen(path, "w") : NULL;
    if (!file) return;
    fprintf(file, "%d %d\n", changes, questions);
    fclose(file);
}
