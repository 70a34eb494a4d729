// The last minutes of every signal, so that one can ask for a plot of what has already been.
export class History {
  // `width` values a sample; the oldest sample goes when there are more than `capacity`.
  constructor(width, capacity) {
    this.width = width;
    this.capacity = capacity;
    this.times = new Float64Array(capacity);
    this.values = new Float32Array(width * capacity);
    this.clear();
  }

  clear() {
    this.begin = 0; // samples are counted from the start of the page; this is the oldest kept
    this.end = 0;
  }

  get newest() {
    return this.end > this.begin ? this.times[(this.end - 1) % this.capacity] : 0;
  }

  get oldest() {
    return this.end > this.begin ? this.times[this.begin % this.capacity] : 0;
  }

  // A time before the last one begins a new history: the robot was started anew.
  push(time, read) {
    if (this.end > this.begin) {
      if (time < this.newest) this.clear();
      else if (time === this.newest) return; // paused
    }
    const slot = this.end % this.capacity;
    this.times[slot] = time;
    const at = slot * this.width;
    for (let i = 0; i < this.width; ++i) this.values[at + i] = read(i);
    ++this.end;
    if (this.end - this.begin > this.capacity) ++this.begin;
  }

  // The first sample at `time` or later.
  find(time) {
    let low = this.begin;
    let high = this.end;
    while (low < high) {
      const middle = Math.floor((low + high) / 2);
      if (this.times[middle % this.capacity] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // Rows [time, value of each column] from `since`, thinned to about `most` rows: of each stretch
  // its extremes are kept, so that no peak is lost.
  rows(columns, since, most) {
    const first = this.find(since);
    const stretch = Math.ceil((2 * (this.end - first)) / most);
    const rows = [];
    if (stretch <= 2) {
      for (let i = first; i < this.end; ++i) rows.push(this.row(columns, i));
      return rows;
    }
    // Stretches keep their places while time goes on, else the picture would shimmer.
    for (let from = first; from < this.end; ) {
      const to = Math.min(from - (from % stretch) + stretch, this.end);
      rows.push(...this.extremes(columns, from, to));
      from = to;
    }
    return rows;
  }

  row(columns, index) {
    const slot = index % this.capacity;
    const row = [this.times[slot]];
    for (const column of columns) row.push(this.values[slot * this.width + column]);
    return row;
  }

  extremes(columns, from, to) {
    const low = this.row(columns, from);
    const high = this.row(columns, to - 1);
    columns.forEach((column, k) => {
      let least = Infinity;
      let most = -Infinity;
      for (let i = from; i < to; ++i) {
        const value = this.values[(i % this.capacity) * this.width + column];
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
      low[k + 1] = least;
      high[k + 1] = most;
    });
    return to - from > 1 ? [low, high] : [low];
  }
}
