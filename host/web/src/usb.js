// Faults of a board that is flashed by WebUSB.

/** The board refused: `command`, `reason`. */
export class Refused extends Error {
  constructor(command, reason) {
    super(`${command}: ${reason}`);
    Object.assign(this, { command, reason });
  }
}

/** The board has other bytes than were written. */
export class Differs extends Error {
  constructor(address) {
    super(`differs at ${address}`);
    this.address = address;
  }
}
