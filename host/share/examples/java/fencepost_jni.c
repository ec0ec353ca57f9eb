/* Between Fencepost.java and fencepost.h. To build, with a JDK in $JAVA_HOME:
   cc -shared -fPIC -I$JAVA_HOME/include -I$JAVA_HOME/include/linux fencepost_jni.c -lfencepost -o libfencepost_jni.so */
#include <fencepost/fencepost.h>
#include <jni.h>
#include <stdio.h>
#include <stdlib.h>

struct robot {
  fencepost_core *core;
  char sentence[160];
};
static struct robot *robot_of(jlong handle) { return (struct robot *)(intptr_t)handle; }
static fencepost_core *core_of(jlong handle) { return handle == 0 ? NULL : robot_of(handle)->core; }

static void hear(void *context, const fencepost_alert *alert) {
  struct robot *robot = context;
  snprintf(robot->sentence, sizeof robot->sentence, "%s", alert->sentence);
}
static jstring refusal(JNIEnv *env, fencepost_answer answer) {
  return answer == FENCEPOST_TAKEN ? NULL : (*env)->NewStringUTF(env, fencepost_answer_text(answer));
}

JNIEXPORT jlong JNICALL Java_Fencepost_create(JNIEnv *env, jclass class) {
  struct robot *robot = calloc(1, sizeof *robot);
  if (robot == NULL) return 0;
  robot->core = fencepost_create(fencepost_full());
  fencepost_on_alert(robot->core, hear, robot);
  return (jlong)(intptr_t)robot;
}
JNIEXPORT void JNICALL Java_Fencepost_destroy(JNIEnv *env, jclass class, jlong handle) {
  fencepost_destroy(core_of(handle));
  free(robot_of(handle));
}
JNIEXPORT jstring JNICALL Java_Fencepost_setCamera(JNIEnv *env, jclass class, jlong handle, jint width, jint height,
                                                   jfloat degrees, jfloat lens_height) {
  fencepost_camera camera = fencepost_pinhole((uint16_t)width, (uint16_t)height, degrees);
  camera.z = lens_height;
  return refusal(env, fencepost_set_camera(core_of(handle), &camera));
}
JNIEXPORT jstring JNICALL Java_Fencepost_setColour(JNIEnv *env, jclass class, jlong handle, jint signature,
                                                   jstring name, jfloat size, jint pad) {
  fencepost_colour colour = {0};
  const char *text = (*env)->GetStringUTFChars(env, name, NULL);
  if (text == NULL) return NULL; /* Java throws that it has no memory */
  colour.signature = (uint8_t)signature;
  colour.name = text;
  colour.size = size;
  colour.pad = (int8_t)(pad < -128 ? -128 : pad > 127 ? 127 : pad);
  const fencepost_answer answer = fencepost_set_colour(core_of(handle), &colour);
  (*env)->ReleaseStringUTFChars(env, name, text);
  return refusal(env, answer);
}
JNIEXPORT jstring JNICALL Java_Fencepost_setPose(JNIEnv *env, jclass class, jlong handle, jlong time, jfloat x,
                                                 jfloat y, jfloat heading) {
  const fencepost_pose pose = {x, y, heading};
  return refusal(env, fencepost_odometry(core_of(handle), time, pose));
}
JNIEXPORT jstring JNICALL Java_Fencepost_setBoxes(JNIEnv *env, jclass class, jlong handle, jlong time,
                                                  jfloatArray numbers) {
  fencepost_box boxes[FENCEPOST_MAX_BOXES];
  size_t count = (size_t)(*env)->GetArrayLength(env, numbers) / 5;
  if (count > FENCEPOST_MAX_BOXES) count = FENCEPOST_MAX_BOXES;
  for (size_t i = 0; i < count; ++i) {
    jfloat box[5];
    (*env)->GetFloatArrayRegion(env, numbers, (jsize)(5 * i), 5, box);
    boxes[i] = fencepost_box_centred((uint8_t)box[0], box[1], box[2], box[3], box[4]);
  }
  return refusal(env, fencepost_boxes(core_of(handle), time, boxes, count));
}
JNIEXPORT jboolean JNICALL Java_Fencepost_step(JNIEnv *env, jclass class, jlong handle, jlong now) {
  fencepost_step(core_of(handle), now);
  return fencepost_may_drive(core_of(handle), now);
}
JNIEXPORT jstring JNICALL Java_Fencepost_alert(JNIEnv *env, jclass class, jlong handle) {
  return (*env)->NewStringUTF(env, handle == 0 ? "" : robot_of(handle)->sentence);
}
