"""Where two bodies touch: sphere and window, bearing area, Hertz, elastic contact, patches."""
