import { defineConfig } from 'vite';

// Nothing is inlined: the server's Content-Security-Policy allows scripts and workers from itself alone.
export default defineConfig({
  base: './',
  build: { target: 'es2022', assetsInlineLimit: 0, modulePreload: { polyfill: false } },
  server: { proxy: { '/api': 'http://127.0.0.1:8377', '/ws': { target: 'ws://127.0.0.1:8377', ws: true } } },
});
