/** Fencepost's core for Java: the C interface by JNI (fencepost_jni.c). Metres, radians, microseconds, pixels. */
public final class Fencepost implements AutoCloseable {
  static {
    System.loadLibrary("fencepost_jni");
  }
  private long core = create();

  /** A camera that sees so many degrees across, its lens so high above the floor. */
  public void camera(int width, int height, float degrees, float lensHeight) {
    check(setCamera(core, width, height, degrees, lensHeight));
  }
  /** A colour's name, the size of its things in metres (0: not known), and by how many pixels its boxes are too wide. */
  public void colour(int signature, String name, float size, int pad) {
    check(setColour(core, signature, name, size, pad));
  }
  public void odometry(long time, float x, float y, float heading) {
    check(setPose(core, time, x, y, heading));
  }
  /** Five numbers a box: signature, middle column, middle row, width, height. */
  public void boxes(long time, float[] numbers) {
    check(setBoxes(core, time, numbers));
  }
  /** Time passes; may the motors run? To be called in each turn. */
  public boolean mayDrive(long now) {
    return step(core, now);
  }
  /** The latest alert's sentence. */
  public String sentence() {
    return alert(core);
  }
  @Override
  public void close() {
    destroy(core);
    core = 0;
  }
  private static void check(String refusal) {
    if (refusal != null) throw new IllegalArgumentException(refusal);
  }

  private static native long create();
  private static native void destroy(long core);
  private static native String setCamera(long core, int width, int height, float degrees, float lensHeight);
  private static native String setColour(long core, int signature, String name, float size, int pad);
  private static native String setPose(long core, long time, float x, float y, float heading);
  private static native String setBoxes(long core, long time, float[] numbers);
  private static native boolean step(long core, long now);
  private static native String alert(long core);
}
