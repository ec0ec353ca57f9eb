/** A robot that is none drives towards a box, 10 cm wide and 15 cm high, and stops before it. */
public final class Stop {
  public static void main(String[] arguments) {
    final float fx = 0.5F * 640 / (float) Math.tan(Math.toRadians(31)), lens = 0.12F, front = 1.5F;
    float x = 0;
    String before = "";
    try (Fencepost robot = new Fencepost()) {
      robot.camera(640, 480, 62, lens);
      robot.colour(1, "red", 0, 0);
      for (long now = 0; now < 8_000_000; now += 20_000) {
        final float depth = front - x, top = 239.5F + fx * (lens - 0.15F) / depth;
        final float foot = Math.min(479, 239.5F + fx * lens / depth);
        robot.odometry(now, x, 0, 0);
        robot.boxes(now, new float[] {1, 319.5F, (top + foot) / 2, fx * 0.1F / depth, foot - top + 1});
        if (robot.mayDrive(now)) x += 0.005F;
        if (!robot.sentence().equals(before)) System.out.println(before = robot.sentence());
      }
    }
    System.out.printf("%.2f m before the box%n", front - x);
  }
}
