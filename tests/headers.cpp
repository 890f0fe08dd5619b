// What nearly every test includes is compiled once, with this.
