/* Work of the library on a thread of its own, while the backend waits and serves interrupts. */
#include "module.h"

#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <miscadmin.h>
#include <pgstat.h>
#include <storage/ipc.h>
#include <storage/latch.h>

/* Deep recursion of the library ends with an error at a depth that this holds. */
#define STACK_BYTES ((size_t)64 << 20)

typedef struct Worker {
  pthread_mutex_t mutex;
  pthread_cond_t changed;
  int done; /* an eventfd, readable when the work is done */
  a3d_status (*work)(void*);
  void* argument;
  a3d_status status;
} Worker;

static Worker* worker; /* of this backend; null until the first long call */
static bool works;     /* whether the thread has work that nobody has waited for */

static void stop_at_exit(int code, Datum unused);

static void* work_for_ever(void* given) {
  Worker* self = given;
  for (;;) {
    uint64_t one = 1;
    pthread_mutex_lock(&self->mutex);
    while (self->work == NULL) pthread_cond_wait(&self->changed, &self->mutex);
    pthread_mutex_unlock(&self->mutex);
    self->status = self->work(self->argument);
    self->work = NULL;
    while (write(self->done, &one, sizeof one) < 0) {
    }
  }
  return NULL;
}

static Worker* started(void) {
  static Worker made = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, -1, NULL, NULL, A3D_OK};
  pthread_attr_t attributes;
  pthread_t thread;
  sigset_t all, before;
  int failed;
  if (made.done < 0) made.done = eventfd(0, EFD_CLOEXEC);
  if (made.done < 0) ereport(ERROR, errcode_for_file_access(), errmsg("could not make an event descriptor: %m"));
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, STACK_BYTES);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  /* Signals are for the backend's own thread; threads inherit the mask, those of the library from this one. */
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  failed = pthread_create(&thread, &attributes, work_for_ever, &made);
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  pthread_attr_destroy(&attributes);
  if (failed != 0)
    ereport(ERROR, errcode(ERRCODE_INSUFFICIENT_RESOURCES), errmsg("could not start a thread: %s", strerror(failed)));
  before_shmem_exit(stop_at_exit, (Datum)0);
  return &made;
}

/* Waits until the descriptor is readable or something is to be served; true if the work is done. */
static bool is_done(int milliseconds) {
  int events = WaitLatchOrSocket(MyLatch, WL_LATCH_SET | WL_SOCKET_READABLE | WL_TIMEOUT | WL_EXIT_ON_PM_DEATH,
                                 worker->done, milliseconds, PG_WAIT_EXTENSION);
  if (events & WL_LATCH_SET) ResetLatch(MyLatch);
  if (events & WL_SOCKET_READABLE) {
    uint64_t count;
    if (read(worker->done, &count, sizeof count) == sizeof count) return true;
  }
  return false;
}

/* Stops the work, and waits for its end. */
static void stop(a3d_session* session) {
  a3d_cancel(session);
  HOLD_INTERRUPTS();
  while (!is_done(1000)) {
  }
  works = false;
  RESUME_INTERRUPTS();
  a3d_resume(session);
}

/* A backend that ends by a fatal error, such as that of a lost client, jumps out of run_aside: the library must not be
 * taken down while the thread uses it. */
static void stop_at_exit(int code, Datum unused) {
  if (works) stop(backend_session());
}

a3d_status run_aside(a3d_status (*work)(void*), void* argument) {
  a3d_session* session = backend_session();
  CHECK_FOR_INTERRUPTS();
  count_heap(false);
  if (worker == NULL) worker = started();
  pthread_mutex_lock(&worker->mutex);
  worker->argument = argument;
  worker->work = work;
  works = true;
  pthread_cond_signal(&worker->changed);
  pthread_mutex_unlock(&worker->mutex);
  while (!is_done(1000)) {
    if (QueryCancelPending || ProcDiePending) {
      stop(session);
      /* It was done before it heard of the request: the caller owns the result, and the server serves the request soon.
       */
      if (worker->status != A3D_ERROR) return worker->status;
      CHECK_FOR_INTERRUPTS();
      /* The request was taken back meanwhile: an error all the same, since the work has ended. */
      ereport(ERROR, errcode(ERRCODE_QUERY_CANCELED), errmsg("canceling statement due to user request"));
    }
    if (InterruptPending) {
      PG_TRY();
      { CHECK_FOR_INTERRUPTS(); }
      PG_CATCH();
      {
        stop(session);
        PG_RE_THROW();
      }
      PG_END_TRY();
    }
  }
  works = false;
  return worker->status;
}
