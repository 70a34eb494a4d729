/* holds_pose SECONDS: commands a released Go2 at 500 Hz, by absolute deadlines, to hold the pose in which it hears it.
   States come by a listener, in a thread of Cyclone's. Prints the last angle of each leg's joints. */
#include <dds/dds.h>
#include <idl/unitree_go.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef unitree_go_msg_dds__LowState_ LowState;
typedef unitree_go_msg_dds__LowCmd_ LowCmd;

enum { kMotors = 12, kPeriod = 2000000 /* ns */ };
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t heard = PTHREAD_COND_INITIALIZER;
static float q[kMotors]; /* rad, the last that were heard */
static long states = 0;

static void on_state(dds_entity_t reader, void* unused) {
  void* samples[1] = {NULL};
  dds_sample_info_t info[1];
  (void)unused;
  while (dds_take(reader, samples, info, 1, 1) > 0) {
    const LowState* state = samples[0];
    pthread_mutex_lock(&lock);
    for (int i = 0; i < kMotors; ++i) q[i] = state->motor_state[i].q;
    ++states;
    pthread_cond_signal(&heard);
    pthread_mutex_unlock(&lock);
    dds_return_loan(reader, samples, 1);
  }
}

/* The vendor's CRC-32 over words, without its last. */
static uint32_t crc_of(const void* message, size_t size) {
  const uint32_t* words = message;
  uint32_t crc = 0xffffffffU;
  for (size_t i = 0; i + 1 < size / 4; ++i) {
    for (uint32_t bit = 1U << 31; bit != 0; bit >>= 1) {
      const uint32_t out = crc & 0x80000000U;
      crc = (crc << 1) ^ (out != 0 ? 0x04c11db7U : 0);
      if (words[i] & bit) crc ^= 0x04c11db7U;
    }
  }
  return crc;
}

static int hear(float* first) {
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_sec += 10;
  int error = 0;
  pthread_mutex_lock(&lock);
  while (states < 2 && error == 0) error = pthread_cond_timedwait(&heard, &lock, &until);
  for (int i = 0; i < kMotors; ++i) first[i] = q[i];
  pthread_mutex_unlock(&lock);
  return error;
}

int main(int count, char** words) {
  const double seconds = count > 1 ? atof(words[1]) : 1;
  const dds_entity_t participant = dds_create_participant(0, NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_listener_t* listener = dds_create_listener(NULL);
  dds_lset_data_available(listener, on_state);
  const dds_entity_t writer = dds_create_writer(
      participant, dds_create_topic(participant, &unitree_go_msg_dds__LowCmd__desc, "rt/lowcmd", NULL, NULL), qos, NULL);
  dds_create_reader(participant,
                    dds_create_topic(participant, &unitree_go_msg_dds__LowState__desc, "rt/lowstate", NULL, NULL), qos,
                    listener);
  float first[kMotors];
  if (hear(first) != 0) return 1;
  static LowCmd command;
  command.head[0] = 0xFE;
  command.head[1] = 0xEF;
  command.level_flag = 0xFF;
  struct timespec next;
  clock_gettime(CLOCK_MONOTONIC, &next);
  for (int n = (int)(seconds * 1e9 / kPeriod); n > 0; --n) {
    for (int i = 0; i < kMotors; ++i) {
      command.motor_cmd[i].mode = 1;
      command.motor_cmd[i].q = first[i];
      command.motor_cmd[i].kp = 60;
      command.motor_cmd[i].kd = 5;
    }
    command.crc = crc_of(&command, sizeof(command));
    dds_write(writer, &command);
    next.tv_nsec += kPeriod;
    if (next.tv_nsec >= 1000000000) {
      next.tv_nsec -= 1000000000;
      ++next.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
  }
  pthread_mutex_lock(&lock);
  for (int i = 0; i < kMotors; ++i) printf("%.6f ", (double)q[i]);
  printf("%ld\n", states);
  pthread_mutex_unlock(&lock);
  dds_delete(participant);
  return 0;
}
